//! Faces of an OBJ file turned over, in its text. All else stays as it is.

use super::text::numbers;

/// The text of an OBJ file in which the corners of some of its faces run the other way round. `turned`
/// has a value for each face, in the order of the file. Turned faces lose their normals, which point to
/// the old front.
pub fn turn_faces(text: &str, turned: &[bool]) -> String {
    let (mut lines, mut turned) = (text.split_inclusive('\n'), turned.iter());
    let mut output = String::with_capacity(text.len());
    while let Some(line) = lines.next() {
        let Some(corners) = line.trim_start().strip_prefix('f').filter(|rest| is_blank(rest))
        else {
            output += line;
            continue;
        };
        let (mut face, mut corners) = (line.to_owned(), numbers(corners).to_owned());
        while corners.ends_with('\\') {
            corners.pop();
            let Some(next) = lines.next() else { break };
            face += next;
            corners += &format!(" {}", numbers(next));
        }
        if turned.next() == Some(&true) {
            let corners: Vec<String> = corners.split_whitespace().rev().map(bare).collect();
            face = format!("f {}\n", corners.join(" "));
        }
        output += &face;
    }
    output
}

/// Whether what follows a keyword separates it from what it is about.
fn is_blank(rest: &str) -> bool {
    rest.starts_with(char::is_whitespace)
}

/// A corner without its normal: 1/2/3 is vertex 1 with texture coordinate 2 and normal 3.
fn bare(corner: &str) -> String {
    let mut numbers = corner.split('/');
    let vertex = numbers.next().unwrap_or_default();
    match numbers.next() {
        Some(texture) if !texture.is_empty() => format!("{vertex}/{texture}"),
        _ => vertex.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::turn_faces;

    #[test]
    fn only_chosen_faces_are_turned() {
        let text = "v 0 0 0\nfoo\nf 1//7 2//8 3//9 # a\n  f 1/4 2/5 \\\n3/6\nf 3 2 1";
        assert_eq!(turn_faces(text, &[false; 3]), text);
        let turned = "v 0 0 0\nfoo\nf 3 2 1\nf 3/6 2/5 1/4\nf 3 2 1";
        assert_eq!(turn_faces(text, &[true, true, false]), turned);
        assert_eq!(turn_faces(&turn_faces(turned, &[true; 3]), &[true; 3]), format!("{turned}\n"));
    }
}
