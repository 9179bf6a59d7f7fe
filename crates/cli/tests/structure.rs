//! The architecture: what each crate and each folder may import, how long files are, and which
//! words they avoid. All violations are reported at once, with their places and the rule.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod imports;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use imports::{Import, Sources, circular, reach};

/// A folder, and what no file in it imports.
const RULES: &[(&str, &str)] = &[
    // The problem is what is solved, by whatever program.
    ("virtwall::problem", "multicomputer virtwall::program virtwall::wire"),
    ("virtwall::problem", "virtwall::on virtwall::casting virtwall::observe"),
    // Messages as bytes; who sends them, and what that costs, is decided elsewhere.
    ("virtwall::wire", "multicomputer virtwall::program virtwall::on"),
    ("virtwall::wire", "virtwall::casting virtwall::observe"),
    // The program says what it does; the back end knows what that costs.
    ("virtwall::program", "multicomputer virtwall::on virtwall::casting virtwall::observe"),
    ("virtwall::program", "std::fs std::path std::thread std::time"),
    // How the host computes a shot early, for any program.
    ("virtwall::casting", "multicomputer virtwall::program virtwall::on"),
    ("virtwall::observe", "virtwall::program virtwall::on"),
    // Each back end can be removed alone.
    ("virtwall::on::simulated", "virtwall::on::threads"),
    ("virtwall::on::threads", "virtwall::on::simulated"),
    // An experiment is what its file says; planning and showing its runs comes later.
    ("lab::experiment", "lab::planning lab::results plotters"),
    ("radiosity::scene", "radiosity::mesh radiosity::shoot radiosity::light"),
    ("radiosity::shoot", "radiosity::light radiosity::picture std::fs"),
    ("multicomputer::network", "multicomputer::bench multicomputer::display"),
    ("multicomputer::node", "multicomputer::bench multicomputer::display"),
];

/// What a crate never imports if crates/README.md says that it knows nothing of something. Where
/// the list is empty, the diagram of crates already excludes it.
const KNOWS_NOTHING_OF: &[(&str, &str)] = &[
    ("bytes", ""),
    ("command line", "clap"),
    ("everything else", ""),
    // `stability` has simple kernels of its own to compare with.
    ("except in its naive methods", ""),
    ("experiment files", "lab"),
    ("experiments", "lab"),
    ("files", "std::fs"),
    ("how a kernel or a link works", "radiosity::shoot::bundle multicomputer::network::wormhole"),
    ("light", "radiosity"),
    ("machines", "multicomputer"),
    ("masks", "radiosity"),
    ("messages", "multicomputer virtwall"),
    ("patches", "radiosity"),
    ("plots", "plotters"),
    ("processors", "multicomputer virtwall"),
    ("tables", "csv"),
    ("time", "desim std::time"),
    ("what pages show", "viewer"),
    ("what runs are", "virtwall"),
];

/// No source file has more lines.
const MOST_LINES: usize = 400;

/// Words to avoid, and what to write instead.
const WORDS: &[(&str, &str)] = &[
    ("anew", "again"),
    ("as luck has it", "at random"),
    ("comes to", "is"),
    ("held against", "compared with"),
    ("is told", "receives"),
    ("makes of it", "does with it"),
    ("manieth", "the number of"),
    ("none that", "no ... that"),
    ("of its own accord", "by itself"),
    ("parcel", "source"),
    ("so many", "n"),
    ("stand beside", "are compared with"),
    ("takes no notice", "ignores"),
    ("to be had", "available"),
    ("whoever", "the caller, the user"),
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Files under a folder of the workspace whose names have this ending, and their texts.
fn files(folder: &str, ending: &str) -> BTreeMap<String, String> {
    let mut files = BTreeMap::new();
    for entry in fs::read_dir(root().join(folder)).unwrap().map(Result::unwrap) {
        let name = entry.file_name().into_string().unwrap();
        let path = format!("{folder}/{name}").trim_start_matches("./").to_owned();
        if entry.file_type().unwrap().is_dir() && !name.starts_with('.') && name != "target" {
            files.extend(self::files(&path, ending));
        } else if name.ends_with(ending) {
            files.insert(path, fs::read_to_string(entry.path()).unwrap());
        }
    }
    files
}

static SOURCES: LazyLock<BTreeMap<String, String>> = LazyLock::new(|| {
    let files = files("crates", ".rs").into_iter();
    files.filter(|(file, _)| file.split('/').nth(2) == Some("src")).collect()
});

/// Modules and their imports, except tests in files of their own.
static IMPORTS: LazyLock<(Sources, Vec<Import>)> = LazyLock::new(|| {
    let used = SOURCES.iter().filter(|(file, _)| !file.ends_with("/tests.rs"));
    let sources = Sources::new(used.map(|(file, text)| (file.as_str(), text.as_str())));
    let imports = sources.imports();
    (sources, imports)
});

static README: LazyLock<String> =
    LazyLock::new(|| fs::read_to_string(root().join("crates/README.md")).unwrap());

/// Crates and what they depend on in the workspace.
fn dependencies() -> BTreeMap<String, BTreeSet<String>> {
    let manifests = files("crates", "Cargo.toml");
    let crates: BTreeSet<&str> = manifests.keys().map(|f| f.split('/').nth(1).unwrap()).collect();
    let dependencies = manifests.values().map(|manifest| {
        let section = manifest.split("\n[").find_map(|part| part.strip_prefix("dependencies]"));
        let names = section.unwrap_or("").lines().filter_map(|line| line.split(['.', ' ']).next());
        names.filter(|name| crates.contains(name)).map(str::to_owned).collect()
    });
    crates.iter().map(|name| (*name).to_owned()).zip(dependencies).collect()
}

fn none(wrong: &[String]) {
    assert!(wrong.is_empty(), "{} violations\n{}", wrong.len(), wrong.join("\n"));
}

fn names(path: &str) -> Vec<String> {
    path.split("::").map(str::to_owned).collect()
}

/// Imports in `folder` of one of the `forbidden` paths, or of what is below it.
fn forbidden(imports: &[Import], folder: &str, forbidden: &str, rule: &str) -> Vec<String> {
    let inside = imports.iter().filter(|import| import.module.starts_with(&names(folder)));
    let wrong = inside.filter_map(|Import { file, line, path, item, .. }| {
        let begin = |prefix: &&str| [path, item].iter().any(|p| p.starts_with(&names(prefix)));
        let prefix = forbidden.split(' ').find(begin)?;
        let path = path.join("::");
        Some(format!("{file}:{line} imports {path}: {folder} never imports {prefix} ({rule})"))
    });
    wrong.collect()
}

#[test]
fn folders_keep_the_rules() {
    let (sources, imports) = &*IMPORTS;
    let rules = RULES.iter().flat_map(|(f, paths)| forbidden(imports, f, paths, "RULES"));
    let mut wrong: Vec<String> = rules.collect();
    let crates = dependencies();
    let tables = RULES.iter().flat_map(|(folder, paths)| [folder, paths]);
    let paths = tables.chain(KNOWS_NOTHING_OF.iter().map(|(_, paths)| paths));
    for path in paths.flat_map(|paths| paths.split(' ')).collect::<BTreeSet<_>>() {
        if crates.contains_key(&names(path)[0]) && !sources.has(&names(path)) {
            wrong.push(format!("a rule names {path}, which does not exist"));
        }
    }
    none(&wrong);
}

#[test]
fn no_folder_or_file_imports_what_imports_it() {
    let circular = circular(&IMPORTS.1);
    let wrong = circular.iter().map(|(from, to, Import { file, line, path, .. })| {
        let path = path.join("::");
        format!("{file}:{line} imports {path}: {to} imports {from}, directly or not")
    });
    none(&wrong.collect::<Vec<_>>());
}

/// The arrows of a diagram. A corner or a branch continues from the name above it.
fn arrows(diagram: &str) -> BTreeSet<(String, String)> {
    let mut above: BTreeMap<usize, String> = BTreeMap::new();
    let mut arrows = BTreeSet::new();
    for line in diagram.lines().filter(|line| line.starts_with("    ")) {
        let line: Vec<char> = line.chars().collect();
        let mut from: Vec<String> = Vec::new();
        let mut at = 0;
        while at < line.len() {
            let name: String = line[at..].iter().take_while(|c| c.is_alphanumeric()).collect();
            let length = name.chars().count();
            if length > 0 {
                arrows.extend(from.drain(..).map(|from| (from, name.clone())));
                above.extend((at..at + length).map(|column| (column, name.clone())));
                from.push(name);
            } else if "├└┼┴".contains(line[at]) {
                from.extend(above.get(&at).cloned());
            }
            at += length.max(1);
        }
    }
    arrows
}

#[test]
fn crates_depend_along_the_arrows_of_the_readme() {
    let arrows = arrows(README.split("\n| crate").next().unwrap());
    let mut wrong = Vec::new();
    for (name, used) in dependencies() {
        let drawn = reach(&arrows, &name);
        let extra = used.difference(&drawn).map(|to| format!("{name} depends on {to}: no arrow"));
        wrong.extend(extra);
        let unused = arrows.iter().filter(|(from, to)| *from == name && !used.contains(to));
        wrong.extend(unused.map(|(_, to)| format!("{name} does not depend on {to}: an arrow")));
    }
    none(&wrong);
}

#[test]
fn crates_know_nothing_of_what_the_readme_says() {
    let rows = README.lines().skip_while(|line| !line.starts_with("| crate ")).skip(2);
    let mut missing = dependencies();
    let mut wrong = Vec::new();
    for row in rows.take_while(|line| line.starts_with('|')) {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let name = cells[1].trim_matches('`');
        missing.remove(name);
        for words in cells[3].split(", ") {
            match KNOWS_NOTHING_OF.iter().find(|(known, _)| *known == words) {
                Some((_, paths)) => wrong.extend(forbidden(&IMPORTS.1, name, paths, words)),
                None => wrong.push(format!("{name}: KNOWS_NOTHING_OF lacks \"{words}\"")),
            }
        }
    }
    wrong.extend(missing.keys().map(|name| format!("crates/README.md lacks {name}")));
    none(&wrong);
}

#[test]
fn files_are_short() {
    let lines = SOURCES.iter().map(|(file, text)| (file, text.lines().count()));
    let long = lines.filter(|(_, n)| *n > MOST_LINES);
    let long = long.map(|(file, n)| format!("{file}: {n} lines, more than {MOST_LINES}"));
    none(&long.collect::<Vec<_>>());
}

/// Uses of `WORDS`, also across lines, in the plural, and in `snake_case` and `CamelCase`.
fn avoided(file: &str, text: &str) -> Vec<String> {
    let mut words: Vec<(usize, String)> = Vec::new();
    for (line, text) in (1..).zip(text.lines()) {
        let mut apart = String::new();
        for c in text.chars() {
            if c.is_uppercase() && apart.ends_with(char::is_lowercase) {
                apart.push(' ');
            }
            apart.push(if c.is_alphanumeric() { c } else { ' ' });
        }
        words.extend(apart.split_whitespace().map(|word| (line, word.to_lowercase())));
    }
    let mut wrong = Vec::new();
    for (phrase, instead) in WORDS {
        let wanted: Vec<&str> = phrase.split(' ').collect();
        for found in words.windows(wanted.len()) {
            let mut pairs = found.iter().zip(&wanted);
            if pairs.all(|((_, word), wanted)| word == wanted || *word == format!("{wanted}s")) {
                wrong.push(format!("{file}:{} \"{phrase}\": write \"{instead}\"", found[0].0));
            }
        }
    }
    wrong
}

#[test]
fn words_are_plain() {
    // Folders of results are the output of runs.
    let ours =
        |(file, _): &(String, String)| !file.starts_with("results/") || file == "results/README.md";
    let documents: BTreeMap<_, _> = files(".", ".md").into_iter().filter(ours).collect();
    let all = SOURCES.iter().chain(&documents);
    none(&all.flat_map(|(file, text)| avoided(file, text)).collect::<Vec<_>>());
}

#[test]
fn forbidden_imports_are_found() {
    let sources = Sources::new([
        ("crates/a/src/lib.rs", "mod b; mod c; pub use c::C;"),
        ("crates/a/src/b.rs", "use std::fmt;\nuse crate::C;\nfn d() { std::fs::read(); }"),
        ("crates/a/src/c.rs", "use std::fs;"),
    ]);
    let found = forbidden(&sources.imports(), "a::b", "a::c std::fs", "rule");
    let expected = [
        "crates/a/src/b.rs:2 imports a::C: a::b never imports a::c (rule)",
        "crates/a/src/b.rs:3 imports std::fs::read: a::b never imports std::fs (rule)",
    ];
    assert_eq!(found, expected);
}

#[test]
fn diagrams_are_read() {
    let text = "    a ──► bb ──► c\n    │     ├────► d ──► c\n    └─────┴────► e\n";
    let pairs = ["a bb", "a e", "bb c", "bb d", "bb e", "d c"];
    let pairs = pairs.map(|pair| pair.split_once(' ').unwrap());
    assert_eq!(arrows(text), pairs.map(|(a, b)| (a.to_owned(), b.to_owned())).into());
}

#[test]
fn words_are_found_across_lines_and_in_names() {
    let found = avoided("f", "/// As luck\n/// has it\nlet x = SourceParcels::new(); // parcelled");
    let expected =
        ["f:1 \"as luck has it\": write \"at random\"", "f:3 \"parcel\": write \"source\""];
    assert_eq!(found, expected);
}
