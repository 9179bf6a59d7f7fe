//! `virtwall formfactors` and `virtwall reference` from outside.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use tempfile::TempDir;

/// Opposed unit squares, the lower one in two triangles; one of the names has a comma.
const SQUARES: &str = "mtllib m.mtl
o floor\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl wall\nf 1 2 3\nf 1 3 4
o lamp, large\nv 0 0 1\nv 0 1 1\nv 1 1 1\nv 1 0 1\nusemtl lamp\nf 5 6 7 8\n";
const MATERIALS: &str = "newmtl wall\nKd 0.5 0.4 0.3\nnewmtl lamp\nKd 0 0 0\nKe 10 9 8\n";
/// Howell C-11.
const EXACT: f64 = 0.199_824_895_7;

fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("s.obj"), SQUARES).unwrap();
    fs::write(folder.path().join("m.mtl"), MATERIALS).unwrap();
    fs::write(folder.path().join("s.json"), r#"{"obj": "s.obj", "patch_size": "2 m"}"#).unwrap();
    folder
}

fn virtwall(folder: &Path, arguments: &str) -> (i32, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_virtwall"));
    command.current_dir(folder).args(arguments.split(' ')).stdin(Stdio::null());
    let output = command.output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

fn succeeds(folder: &Path, arguments: &str) -> String {
    let (code, stdout, stderr) = virtwall(folder, arguments);
    assert_eq!((code, stderr.as_str()), (0, ""), "{arguments}");
    stdout
}

#[test]
fn form_factors_of_objects() {
    let folder = folder();
    for (method, within) in [("exact --tolerance 1e-9", 1e-9), ("rays --rays 65536", 0.02)] {
        let csv = succeeds(
            folder.path(),
            &format!("formfactors s.obj --method {method} --format csv --threads 1"),
        );
        let rows: Vec<&str> = csv.lines().collect();
        assert_eq!(rows[0], "from,to,form_factor,error_estimate");
        assert_eq!(rows.len(), 5);
        assert!(rows[1].starts_with("floor,floor,0,"), "{csv}");
        for (row, start) in
            [(rows[2], "floor,\"lamp, large\","), (rows[3], "\"lamp, large\",floor,")]
        {
            let numbers = row.strip_prefix(start).unwrap().split(',');
            let [value, error] = numbers.map(|n| n.parse::<f64>().unwrap()).collect::<Vec<_>>()[..]
            else {
                panic!("{row}")
            };
            assert!((value - EXACT).abs() <= 4.0 * error + 1e-10 && error <= within, "{row}");
        }
        let command = format!("formfactors s.obj --method {method} --format csv --output f.csv");
        assert_eq!(succeeds(folder.path(), &command), "");
        assert_eq!(fs::read_to_string(folder.path().join("f.csv")).unwrap(), csv);
    }
    let json = succeeds(folder.path(), "formfactors s.obj --format json");
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["form_factors"][1]["to"], "lamp, large");
    assert!(succeeds(folder.path(), "formfactors s.json").contains("0.19982"));
}

/// Rows of a closed cube sum to 1; what a cube without its ceiling lacks is what the ceiling would get.
#[test]
fn rows_of_faces_close() {
    let folder = folder();
    let cube = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\no cube\nf 1 2 3 4\n\
                f 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";
    fs::write(folder.path().join("open.obj"), cube).unwrap();
    fs::write(folder.path().join("closed.obj"), cube.to_owned() + "f 8 7 6 5\n").unwrap();
    let rows = |arguments: &str| -> Vec<(String, String, f64)> {
        let (code, csv, _) =
            virtwall(folder.path(), &format!("formfactors {arguments} --format csv"));
        assert_eq!(code, 0);
        let cells = csv.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>());
        cells.map(|c| (c[0].to_owned(), c[1].to_owned(), c[2].parse().unwrap())).collect()
    };
    let of = |rows: &[(String, String, f64)], from: &str, to: &str| {
        rows.iter().find(|row| row.0 == from && row.1 == to).map(|row| row.2)
    };
    for method in ["exact --tolerance 1e-9", "rays --rays 262144"] {
        let within = if method.starts_with("exact") { 1e-7 } else { 0.01 };
        let closed = rows(&format!("closed.obj --between faces --sums --method {method}"));
        assert_eq!(closed.len(), 6 * 8);
        for face in 1..=6 {
            let sky = of(&closed, &format!("cube/{face}"), "(sky)").unwrap();
            assert!(sky.abs() < within, "{sky}");
        }
        let open = rows(&format!("open.obj --between faces --sums --method {method}"));
        let sky = of(&open, "cube/1", "(sky)").unwrap();
        assert!((sky - EXACT).abs() < within, "{sky}");
    }
    let most = rows("closed.obj --between faces --sums --least 0.2");
    assert_eq!(of(&most, "cube/1", "cube/6"), None);
    assert!((of(&most, "cube/1", "(less)").unwrap() - EXACT).abs() < 1e-6);
    assert_eq!(rows("closed.obj").len(), 1);
}

#[test]
fn references_are_stored_with_their_errors() {
    let folder = folder();
    let said = succeeds(folder.path(), "reference s.json --tolerance 1e-9");
    assert!(said.starts_with("results/references/s.json: 3 patches"), "{said}");
    let stored = fs::read_to_string(folder.path().join("results/references/s.json")).unwrap();
    let stored: reference::Reference = serde_json::from_str(&stored).unwrap();
    // Both triangles together see as much of the lamp as the square.
    let mean = (stored.radiosity[0][0] + stored.radiosity[1][0]) / 2.0;
    assert!((mean - 10.0 * 0.5 * EXACT).abs() < 1e-8, "{mean}");
    assert_eq!(stored.radiosity[2], [10.0, 9.0, 8.0]);
    assert!(stored.relative_l2_error < 1e-8);

    let csv = "reference s.json --format csv --output s.csv";
    succeeds(folder.path(), csv);
    assert_eq!(fs::read_to_string(folder.path().join("s.csv")).unwrap().lines().count(), 4);
}

/// An interrupted run leaves its rounds, and ends as if it had not been interrupted.
#[test]
fn paths_go_on_where_they_were() {
    let folder = folder();
    let paths = "reference s.json --method paths --paths 128000 --output p.json --threads";
    succeeds(folder.path(), &format!("{paths} 1"));
    let read = |name: &str| fs::read_to_string(folder.path().join(name));
    let whole = read("p.json").unwrap();
    assert!(read("p.json.partial").is_err());
    succeeds(folder.path(), &format!("{paths} 3"));
    assert_eq!(read("p.json").unwrap(), whole);

    // One that is killed leaves what it has found.
    fs::remove_file(folder.path().join("p.json")).unwrap();
    let mut killed = Command::new(env!("CARGO_BIN_EXE_virtwall"))
        .current_dir(folder.path())
        .args(format!("{paths} 1").split(' '))
        .spawn()
        .unwrap();
    let partial = loop {
        if let Ok(partial) = read("p.json.partial") {
            break partial;
        }
        assert!(killed.try_wait().unwrap().is_none(), "it ended before it could be killed");
    };
    killed.kill().unwrap();
    killed.wait().unwrap();
    assert!(read("p.json").is_err(), "it ended before it was killed");
    let partial = lab::unsealed("", &partial).unwrap();
    let resumed_from = |text: &str| {
        fs::write(folder.path().join("p.json.partial"), text).unwrap();
        succeeds(folder.path(), &format!("{paths} 2"));
        read("p.json").unwrap()
    };
    // Tampered with, it tells whether it is read again.
    let tampered = partial.replacen("\"sum\":[[", "\"sum\":[[1000", 1);
    assert_ne!(resumed_from(&lab::sealed("", &tampered)), whole);
    // One that is damaged, or of another subject, is not.
    let sealed = lab::sealed("", partial);
    assert_eq!(resumed_from(&sealed.replacen("\"sum\":[[", "\"sum\":[[1000", 1)), whole);
    assert_eq!(resumed_from(&lab::sealed("", &partial.replace("1996", "7"))), whole);
}

#[test]
fn bad_input_is_refused() {
    let folder = folder();
    for (arguments, expected) in [
        ("formfactors attic", "attic"),
        ("formfactors s.obj --tolerance 0", "expected a number from 1e-12 to 0.1"),
        ("formfactors s.obj --method rays --rays 0", "--rays"),
        ("formfactors s.obj --format xml", "xml"),
        ("formfactors s.obj --least 2", "expected a number from 0 to 1"),
        ("formfactors s.obj --output no/where.csv", "no/where.csv"),
        ("reference s.json --method dense --problem continuum", "patches only"),
        ("reference s.json --paths 0", "--paths"),
        ("reference s.json --output no/where.json", "no/where.json"),
    ] {
        let (code, stdout, stderr) = virtwall(folder.path(), arguments);
        assert_eq!((code, stdout.as_str()), (2, ""), "{arguments}: {stderr}");
        assert!(stderr.starts_with("error: ") && stderr.contains(expected), "{stderr}");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 3, "{arguments}");
    }
}

/// A lamp in the ceiling's plane gives the same answers before and after the ceiling in the file.
#[test]
fn the_order_of_overlapping_faces_does_not_matter() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("m.mtl", "newmtl white\nKd 0.7 0.6 0.5\nnewmtl lamp\nKd 0 0 0\nKe 50 40 30\n");
    let vertices =
        "mtllib m.mtl\nv 0 0 0\nv 1.6 0 0\nv 1.6 1.2 0\nv 0 1.2 0\nv 0 0 1.1\nv 1.6 0 1.1
v 1.6 1.2 1.1\nv 0 1.2 1.1\nv 0.6 0.4 1.1\nv 1.0 0.4 1.1\nv 1.0 0.7 1.1\nv 0.6 0.7 1.1\n";
    let sides =
        "usemtl white\no floor\nf 1 2 3 4\no sides\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";
    let (ceiling, lamp) =
        ("usemtl white\no ceiling\nf 8 7 6 5\n", "usemtl lamp\no lamp\nf 12 11 10 9\n");
    let mut found = Vec::new();
    for (name, last) in [("a", [ceiling, lamp].concat()), ("b", [lamp, ceiling].concat())] {
        write(&format!("{name}.obj"), &[vertices, sides, &last].concat());
        write(
            &format!("{name}.json"),
            &format!(r#"{{"obj": "{name}.obj", "patch_size": "0.8 m"}}"#),
        );
        let run = |arguments: &str| {
            let (code, said, stderr) = virtwall(folder.path(), arguments);
            assert_eq!(code, 0, "{arguments}: {stderr}");
            said
        };
        let factors = run(&format!("formfactors {name}.obj --format csv"));
        let rows: Vec<&str> =
            factors.lines().filter(|row| row.starts_with("lamp,floor,")).collect();
        let factor: f64 = rows[0].split(',').nth(2).unwrap().parse().unwrap();
        // W of red light on all patches, for both methods.
        let light = ["dense", "paths"].map(|method| {
            let arguments =
                format!("reference {name}.json --method {method} --format csv --output r.csv");
            run(&arguments);
            let csv = fs::read_to_string(folder.path().join("r.csv")).unwrap();
            let watts = csv.lines().skip(1).map(|row| {
                let number = |place| row.split(',').nth(place).unwrap().parse::<f64>().unwrap();
                number(5) * number(6)
            });
            watts.sum::<f64>()
        });
        found.push((factor, light));
    }
    let [(one, [dense, paths]), (other, [dense_too, paths_too])] = found[..] else { panic!() };
    // The value of a closed formula, with the lamp in front.
    assert!((one - 0.323_440).abs() < 2e-6 && (one - other).abs() < 2e-6, "{one} {other}");
    assert!((dense / dense_too - 1.0).abs() < 1e-3, "{dense} {dense_too}");
    assert!((paths / paths_too - 1.0).abs() < 1e-2, "{paths} {paths_too}");
    assert!((paths / dense - 1.0).abs() < 2e-2, "{paths} {dense}");
}

/// Errors are relative to the reflected light, so a reference without light is refused.
#[test]
fn a_dark_reference_is_refused() {
    let folder = folder();
    fs::write(folder.path().join("m.mtl"), MATERIALS.replace("Ke 10 9 8", "")).unwrap();
    for method in ["dense", "paths --paths 64"] {
        let arguments = format!("reference s.json --method {method} --output dark.json");
        let (code, said, stderr) = virtwall(folder.path(), &arguments);
        assert_eq!((code, said.as_str()), (2, ""));
        assert!(stderr.contains("s.json: no light is reflected; expected some"), "{stderr}");
        assert!(!folder.path().join("dark.json").exists());
    }
}
