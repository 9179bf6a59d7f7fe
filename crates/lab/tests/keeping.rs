//! Shots kept in files: found again, and never a wrong result.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use std::fs;
use std::path::PathBuf;
use std::sync::Arc;

use common::{Project, SWEEP, options};
use lab::{Endings, Options, Plan, Preparing, Results, ShotFiles, carry_out};

fn swept(project: &Project, memory: usize) -> (Results, Endings) {
    let plan = Plan::read(&project.path("experiments/x.json"), &[], &Preparing::default()).unwrap();
    let shot_files = Some(ShotFiles::open(&project.path("shots")).unwrap());
    let options = Options { fresh: true, memory, shot_files, ..options(2) };
    let endings = carry_out(&plan, &project.path("out"), &options, Arc::new(|_| {})).unwrap();
    assert_eq!(options.shot_files.as_ref().unwrap().trouble(), None);
    (Results::of(&plan, &endings, &options).unwrap(), endings)
}

fn files(project: &Project) -> Vec<PathBuf> {
    let entries = fs::read_dir(project.path("shots")).unwrap();
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

#[test]
fn a_second_sweep_casts_nothing() {
    let project = Project::new(SWEEP);
    let (results, cold) = swept(&project, 1 << 30);
    assert!(cold.shots.cast > 0 && cold.shots.archived == 0, "{:?}", cold.shots);
    // One for each number of pixels.
    assert_eq!(files(&project).len(), 2);
    for memory in [1 << 30, 0] {
        let (again, warm) = swept(&project, memory);
        assert_eq!((again.table == results.table, warm.shots.cast), (true, 0));
        assert_eq!(warm.shots.asked(), cold.shots.asked());
        assert!(warm.shot_bytes <= memory);
        assert_eq!(files(&project).len(), 2, "nothing was cast, nothing written");
    }
}

/// Without room in memory, shots of one run are found in the file by the next.
#[test]
fn what_memory_has_no_room_for_is_found_in_files() {
    let project = Project::new(SWEEP);
    let (_, cold) = swept(&project, 0);
    assert_eq!(cold.shots.in_memory, 0);
    assert!(cold.shots.archived > cold.shots.cast, "{:?}", cold.shots);
}

/// Whichever byte is damaged, and wherever a file ends, results are the same; what was not harmed is
/// still found.
#[test]
fn damage_is_never_a_wrong_result() {
    let project = Project::new(&SWEEP.replace("[64, 256]", "64"));
    let (results, cold) = swept(&project, 1 << 30);
    let path = files(&project).remove(0);
    let whole = fs::read(&path).unwrap();
    for (i, at) in (0..whole.len()).step_by(whole.len() / 40 + 1).enumerate() {
        let mut spoiled = whole.clone();
        if i % 2 == 0 {
            spoiled[at] ^= 0x10;
        } else {
            spoiled.truncate(at);
        }
        files(&project).iter().for_each(|path| fs::remove_file(path).unwrap());
        fs::write(&path, &spoiled).unwrap();
        let (again, warm) = swept(&project, 1 << 30);
        assert!(again.table == results.table, "{at}");
        assert!((1..=cold.shots.cast).contains(&warm.shots.cast), "{at}: {:?}", warm.shots);
        // What was missing was written, to another file, and nothing is missing now.
        assert_eq!((swept(&project, 1 << 30).1.shots.cast, files(&project).len()), (0, 2));
    }
}

/// Records whose checksums are right are not believed if they are of another scene, or no whole shots.
#[test]
fn forged_records_are_never_a_wrong_result() {
    let project = Project::new(&SWEEP.replace("[64, 256]", "64"));
    let (results, cold) = swept(&project, 1 << 30);
    let path = files(&project).remove(0);
    let whole = fs::read(&path).unwrap();
    let scene = fs::read_to_string(project.path("scenes/box.mtl")).unwrap();
    project.write("scenes/box.mtl", &scene.replace("0.5", "0.4"));
    let (other, _) = swept(&project, 1 << 30);
    let at = whole.iter().position(|&byte| byte == b'\n').unwrap();
    let theirs = files(&project).into_iter().find(|other| *other != path).unwrap();
    let header = fs::read(&theirs).unwrap()[..at].to_vec();
    fs::write(&theirs, [&header, &whole[at..]].concat()).unwrap();
    let (again, warm) = swept(&project, 1 << 30);
    assert!(again.table == other.table && again.table != results.table);
    assert_eq!(warm.shots.cast, cold.shots.cast);
}

/// A folder that can no longer be written to costs the kept shots, not the results.
#[test]
fn a_folder_that_has_gone_is_told() {
    let project = Project::new(SWEEP);
    let (results, _) = swept(&project, 1 << 30);
    let plan = Plan::read(&project.path("experiments/x.json"), &[], &Preparing::default()).unwrap();
    let shot_files = Some(ShotFiles::open(&project.path("gone")).unwrap());
    fs::remove_dir(project.path("gone")).unwrap();
    let options = Options { fresh: true, shot_files, ..options(1) };
    let endings = carry_out(&plan, &project.path("out"), &options, Arc::new(|_| {})).unwrap();
    assert!(Results::of(&plan, &endings, &options).unwrap().table == results.table);
    let trouble = options.shot_files.unwrap().trouble().unwrap();
    assert!(trouble.contains("gone: "), "{trouble}");
}

/// Three sweeps at a time, each with files of its own.
#[test]
fn sweeps_at_a_time_do_not_harm_each_other() {
    let project = Project::new(SWEEP);
    let tables = std::thread::scope(|scope| {
        let sweeps = [(); 3].map(|()| {
            scope.spawn(|| {
                let plan =
                    Plan::read(&project.path("experiments/x.json"), &[], &Preparing::default())
                        .unwrap();
                let shot_files = Some(ShotFiles::open(&project.path("shots")).unwrap());
                let options = Options { memory: 1 << 20, shot_files, ..options(1) };
                let out = tempfile::tempdir().unwrap();
                let endings = carry_out(&plan, out.path(), &options, Arc::new(|_| {})).unwrap();
                Results::of(&plan, &endings, &options).unwrap().table
            })
        });
        sweeps.map(|sweep| sweep.join().unwrap())
    });
    assert!(tables[0] == tables[1] && tables[1] == tables[2]);
    let (results, warm) = swept(&project, 1 << 30);
    assert_eq!((results.table == tables[0], warm.shots.cast), (true, 0));
}

/// Shots of other settings are not taken for these.
#[test]
fn what_decides_a_shot_decides_its_file() {
    let project = Project::new(SWEEP);
    let cast = || swept(&project, 1 << 30).1.shots.cast;
    let cold = cast();
    assert_eq!(cast(), 0);
    // The machine and the rules decide no shot; materials might: the whole scene counts.
    project.write(
        "experiments/x.json",
        &SWEEP.replace("\"title\"", "\"ties\": \"local_first\", \"title\""),
    );
    assert!(cast() < cold);
    for (from, to) in [("1 m", "0.8 m"), ("8x4x4", "8x6x4"), ("4x1x1", "2x2x1")] {
        let scene = fs::read_to_string(project.path("scenes/box.json")).unwrap();
        project.write("scenes/box.json", &scene.replace(from, to));
        assert!(cast() > 0, "{to}");
        assert_eq!(cast(), 0, "{to}");
    }
    let turned = SWEEP.replace("[64, 256]", "[64, 256], \"rotated\": false");
    project.write("experiments/x.json", &turned);
    assert!(cast() > 0);
    let scene = fs::read_to_string(project.path("scenes/box.obj")).unwrap();
    project.write("scenes/box.obj", &scene.replace("1.9", "1.8"));
    assert!(cast() > 0);
}
