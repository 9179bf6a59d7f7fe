//! Which source file imports what: all `use` items and all paths in expressions and types, resolved
//! through re-exports to the file that defines the item. What is under `#[cfg(test)]` is left out.

use std::array::from_fn;
use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// A path, `a::b::c`, by its names.
pub type Names = Vec<String>;

pub struct Import {
    pub file: String,
    pub line: usize,
    /// The module that imports, what it imports, and what that is behind all re-exports; all three
    /// begin with a crate.
    pub module: Names,
    pub path: Names,
    pub item: Names,
    /// The file that defines the item, if it is in the workspace.
    pub target: Option<String>,
    /// Whether a module re-exports what its own children define.
    reexport: bool,
}

/// A path as it is written. `name` is what a `use` calls it, and empty elsewhere.
struct Mention {
    path: Names,
    name: String,
    public: bool,
    line: usize,
}

#[derive(Default)]
struct Module {
    file: String,
    mentions: Vec<Mention>,
}

/// All modules of all crates.
#[derive(Default)]
pub struct Sources(BTreeMap<Names, Module>);

impl Sources {
    /// `files`: paths such as `crates/lab/src/run/runner.rs`, and their texts.
    pub fn new<'a>(files: impl IntoIterator<Item = (&'a str, &'a str)>) -> Sources {
        let mut sources = Sources::default();
        for (file, text) in files {
            let parts = file.trim_end_matches(".rs").split('/').skip(1).filter(|p| *p != "src");
            let mut module: Names = parts.map(str::to_owned).collect();
            module.pop_if(|last| ["lib", "main", "mod"].contains(&last.as_str()));
            let stream = text.parse().unwrap_or_else(|error| panic!("{file}: {error}"));
            file.clone_into(&mut sources.0.entry(module.clone()).or_default().file);
            sources.read(&module, &tokens(stream));
        }
        sources
    }

    pub fn has(&self, module: &[String]) -> bool {
        self.0.contains_key(module)
    }

    pub fn imports(&self) -> Vec<Import> {
        let mut imports = Vec::new();
        for (module, Module { file, mentions }) in &self.0 {
            for mention in mentions {
                let path = self.absolute(module, mention);
                let (home, item) = self.resolve(path.clone(), 0);
                let target = home.map(|home| self.0[&home].file.clone());
                let target = target.filter(|file| !file.is_empty());
                let (file, line, module) = (file.clone(), mention.line, module.clone());
                let reexport = mention.public && item.starts_with(&module);
                imports.push(Import { file, line, module, path, item, target, reexport });
            }
        }
        imports.retain(|import| import.target.as_ref() != Some(&import.file));
        imports
    }

    fn read(&mut self, module: &[String], mut tokens: &[Token]) {
        while let [first, ..] = tokens {
            let texts: [&str; 4] = from_fn(|i| tokens.get(i).map_or("", |t| t.text.as_str()));
            let find = |ends: &[&str]| {
                let found = tokens.iter().position(|token| ends.contains(&token.text.as_str()));
                found.unwrap_or(tokens.len() - 1)
            };
            let mut found = Vec::new();
            let read = match texts {
                ["#", "[", ..] if tokens[1].is_cfg_test() => find(&[";", "{"]) + 1,
                ["mod", name, "{", ..] => {
                    let inner = [module, &[name.to_owned()]].concat();
                    let file = self.0[module].file.clone();
                    self.0.entry(inner.clone()).or_default().file = file;
                    self.read(&inner, &tokens[2].inside);
                    3
                }
                // Where `#[path]` puts its text outside of the sources, it has no file.
                ["mod", name, ";", ..] => {
                    self.0.entry([module, &[name.to_owned()]].concat()).or_default();
                    2
                }
                ["use", next, ..] | ["pub", "use", next, ..] | ["pub", "(", "use", next]
                    if next != "<" =>
                {
                    let tree = &tokens[find(&["use"]) + 1..find(&[";"])];
                    use_tree(tree, &[], first.text == "pub", &mut found);
                    find(&[";"])
                }
                [name, ":", ":", next] if is_name(name) && is_name(next) => {
                    let goes_on =
                        |c: &&[Token]| c[0].text == ":" && c[1].text == ":" && is_name(&c[2].text);
                    let more = tokens[1..].chunks_exact(3).take_while(goes_on).count();
                    let names = tokens.iter().step_by(3).take(more + 1);
                    let path = names.map(|token| token.text.clone()).collect();
                    let name = String::new();
                    found.push(Mention { path, name, public: false, line: first.line });
                    3 * more + 1
                }
                _ => {
                    self.read(module, &first.inside);
                    1
                }
            };
            self.0.entry(module.to_vec()).or_default().mentions.extend(found);
            tokens = &tokens[read..];
        }
    }

    /// The path from its crate on, as the module's own text says.
    fn absolute(&self, module: &[String], Mention { path, name, .. }: &Mention) -> Names {
        let used = self.0[module].mentions.iter().find(|other| other.name == path[0]);
        if let (true, Some(used)) = (name.is_empty(), used) {
            return [self.absolute(module, used).as_slice(), &path[1..]].concat();
        }
        let supers = path.iter().take_while(|name| *name == "super").count();
        match path[0].as_str() {
            "crate" => [&module[..1], &path[1..]].concat(),
            "self" => [module, &path[1..]].concat(),
            "super" => [&module[..module.len() - supers], &path[supers..]].concat(),
            _ if self.has(&[module, &path[..1]].concat()) => [module, path].concat(),
            _ => path.clone(),
        }
    }

    /// The module that defines what the path names, and the path to it there.
    fn resolve(&self, path: Names, depth: usize) -> (Option<Names>, Names) {
        if !self.has(&path[..1]) {
            return (None, path);
        }
        let mut home = 1;
        while let Some(name) = path.get(home) {
            let is_module = self.has(&path[..=home]);
            let used = self.0[&path[..home]].mentions.iter().find(|used| used.name == *name);
            match used {
                // A module and an item of the same name: the item, if the path ends here.
                Some(used) if depth < 8 && (home + 1 == path.len() || !is_module) => {
                    let target = self.absolute(&path[..home], used);
                    return self.resolve([&target, &path[home + 1..]].concat(), depth + 1);
                }
                _ if is_module => home += 1,
                _ => break,
            }
        }
        (Some(path[..home].to_vec()), path)
    }
}

/// Circles among the files and subfolders of a folder: for each step what imports, what is imported,
/// and the first such import. A subfolder stands for all that is in it.
pub fn circular(imports: &[Import]) -> Vec<(String, String, &Import)> {
    let targets = imports.iter().filter_map(|import| import.target.as_ref());
    let files: BTreeSet<&String> = imports.iter().map(|i| &i.file).chain(targets).collect();
    let mut steps = Vec::new();
    for import in imports.iter().filter(|import| !import.reexport) {
        let Some(target) = &import.target else { continue };
        let (from, to) = (place(&import.file, &files), place(target, &files));
        let common = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
        steps.push((from[..=common].join("/"), to[..=common].join("/"), import));
    }
    let arrows = steps.iter().map(|(from, to, _)| (from.clone(), to.clone())).collect();
    let back: BTreeMap<String, BTreeSet<String>> =
        steps.iter().map(|(_, to, _)| (to.clone(), reach(&arrows, to))).collect();
    steps.retain(|(from, to, _)| back[to].contains(from));
    steps.sort_by(|a, b| (&a.0, &a.1).cmp(&(&b.0, &b.1)));
    steps.dedup_by(|a, b| (&a.0, &a.1) == (&b.0, &b.1));
    steps
}

/// All that arrows lead to from `start`, with itself.
pub fn reach(arrows: &BTreeSet<(String, String)>, start: &str) -> BTreeSet<String> {
    let mut reached = BTreeSet::new();
    let mut next = vec![start.to_owned()];
    while let Some(from) = next.pop() {
        let here = arrows.iter().filter(|arrow| arrow.0 == from).map(|arrow| arrow.1.clone());
        next.extend(here.filter(|to| !reached.contains(to)));
        reached.insert(from);
    }
    reached
}

/// A file's folders and name; `a.rs` with a folder `a` beside it is in that folder.
fn place<'a>(file: &'a str, files: &BTreeSet<&String>) -> Vec<&'a str> {
    let mut place: Vec<&str> = file.split('/').collect();
    let folder = file.trim_end_matches(".rs");
    if files.iter().any(|file| file.starts_with(&format!("{folder}/"))) {
        place.insert(place.len() - 1, folder.rsplit('/').next().unwrap_or(folder));
    }
    place
}

/// A token, or a pair of brackets: the text is the opening one.
struct Token {
    text: String,
    line: usize,
    inside: Vec<Token>,
}

impl Token {
    fn is_cfg_test(&self) -> bool {
        matches!(self.inside.as_slice(), [cfg, condition]
            if cfg.text == "cfg" && condition.inside.iter().any(|token| token.text == "test"))
    }
}

fn tokens(stream: TokenStream) -> Vec<Token> {
    let token = |tree: TokenTree| {
        let line = tree.span().start().line;
        let TokenTree::Group(group) = tree else {
            return Token { text: tree.to_string(), line, inside: Vec::new() };
        };
        let text = match group.delimiter() {
            Delimiter::Brace => "{",
            Delimiter::Bracket => "[",
            Delimiter::Parenthesis | Delimiter::None => "(",
        };
        Token { text: text.to_owned(), line, inside: tokens(group.stream()) }
    };
    stream.into_iter().map(token).collect()
}

fn is_name(text: &str) -> bool {
    text.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// The branches of what follows `use`, such as `a::{b, c::{self, d as e}}`.
fn use_tree(tokens: &[Token], start: &[String], public: bool, found: &mut Vec<Mention>) {
    for branch in tokens.split(|token| token.text == ",").filter(|branch| !branch.is_empty()) {
        let mut path = start.to_vec();
        let mut alias = None;
        for (i, token) in branch.iter().enumerate() {
            match token.text.as_str() {
                "{" => use_tree(&token.inside, &path, public, found),
                "as" => alias = Some(branch[i + 1].text.clone()),
                "self" if !path.is_empty() => {}
                text if text != ":" && alias.is_none() => path.push(text.to_owned()),
                _ => {}
            }
        }
        if branch.iter().all(|token| token.text != "{") {
            let name = alias.unwrap_or_else(|| path[path.len() - 1].clone());
            found.push(Mention { path, name, public, line: branch[0].line });
        }
    }
}

/// What a made-up file `crates/a/src/b/c.rs` imports, and from which files.
fn made_up(text: &str) -> Vec<String> {
    let sources = Sources::new([
        ("crates/a/src/lib.rs", "mod b; mod d; pub use d::Thing;"),
        ("crates/a/src/b/mod.rs", "pub mod c; mod e; pub use e::{Other as Renamed, One};"),
        ("crates/a/src/b/c.rs", text),
        ("crates/a/src/b/e.rs", ""),
        ("crates/a/src/d.rs", ""),
        ("crates/f/src/lib.rs", "mod g; pub use g::h;"),
        ("crates/f/src/g.rs", "fn h() {}"),
    ]);
    let of_c = sources.imports().into_iter().filter(|import| import.file.ends_with("c.rs"));
    let show = |i: Import| {
        let file = i.target.unwrap_or_default().replace("crates/", "").replace("src/", "");
        format!("{} {} {file}", i.line, i.item.join("::"))
    };
    of_c.map(show).collect()
}

#[test]
fn imports_lead_to_what_defines_an_item() {
    let nested = made_up("use crate::{b::{self, Renamed},\n d::{Some as S, *}};");
    let expected = [
        "1 a::b a/b/mod.rs",
        "1 a::b::e::Other a/b/e.rs",
        "2 a::d::Some a/d.rs",
        "2 a::d::* a/d.rs",
    ];
    assert_eq!(nested, expected);
    assert_eq!(made_up("pub(crate) use super::One;"), ["1 a::b::e::One a/b/e.rs"]);
    assert_eq!(made_up("use super::super::Thing;"), ["1 a::d::Thing a/d.rs"]);
    assert_eq!(made_up("use f::h; fn i() { h() }"), ["1 f::g::h f/g.rs"]);
    let inline = "fn i(x: crate::Thing) { println!(\"{}\", std::fs::read(super::e::j::<u8>())) }";
    let expected = ["1 a::d::Thing a/d.rs", "1 std::fs::read ", "1 a::b::e::j a/b/e.rs"];
    assert_eq!(made_up(inline), expected);
    let aliased = made_up("use crate::d as e; mod k { use super::super::One; } fn l() { e::i() }");
    assert_eq!(aliased, ["1 a::d a/d.rs", "1 a::d::i a/d.rs", "1 a::b::e::One a/b/e.rs"]);
    let test = "/// [`crate::Thing`]\n #[cfg(test)] mod tests { use crate::Thing; } use std::fmt;";
    assert_eq!(made_up(test), ["2 std::fmt "]);
}

#[test]
fn circles_are_found() {
    let found = |files: &[(&str, &str)]| {
        let imports = Sources::new(files.iter().copied()).imports();
        let show = |step: &(String, String, &Import)| {
            format!("{} {}", step.0, step.1).replace("crates/a/src/", "")
        };
        circular(&imports).iter().map(show).collect::<Vec<_>>()
    };
    let three = [
        ("crates/a/src/lib.rs", "mod b; mod c; mod d; pub use b::B;"),
        ("crates/a/src/b.rs", "use crate::c::C; struct B;"),
        ("crates/a/src/c.rs", "use crate::d::D;"),
        ("crates/a/src/d.rs", "use crate::B;"),
    ];
    assert_eq!(found(&three), ["b.rs c.rs", "c.rs d.rs", "d.rs b.rs"]);
    assert!(found(&three[..3]).is_empty());
    let two_folders = [
        ("crates/a/src/b/c.rs", "use crate::e::f::F;"),
        ("crates/a/src/b/d.rs", ""),
        ("crates/a/src/e.rs", "mod f; mod g;"),
        ("crates/a/src/e/f.rs", ""),
        ("crates/a/src/e/g.rs", "use crate::b::d::D;"),
        ("crates/a/src/lib.rs", "mod b; mod e;"),
    ];
    assert_eq!(found(&two_folders), ["b e", "e b"]);
    let parent_and_child = [
        ("crates/a/src/lib.rs", "mod b; use b::B; struct A;"),
        ("crates/a/src/b.rs", "use super::A;"),
    ];
    assert_eq!(found(&parent_and_child), ["b.rs lib.rs", "lib.rs b.rs"]);
}
