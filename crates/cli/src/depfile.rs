//! Dep-files: which files the outputs were made from, as a Makefile rule that make and ninja read.

use std::path::Path;

/// `target: dependencies`, one dependency a line. One target, because ninja takes no more; ours is the manifest, which
/// changes whenever any file beside it does.
pub(crate) fn rule<'a>(target: &Path, dependencies: impl IntoIterator<Item = &'a Path>) -> String {
    let mut text = format!("{}:", escape(target));
    for dependency in dependencies {
        text.push_str(" \\\n  ");
        text.push_str(&escape(dependency));
    }
    text.push('\n');
    text
}

/// make's escapes: a backslash before spaces and `#`, `$` doubled. A backslash before a space doubles too.
fn escape(path: &Path) -> String {
    let mut escaped = String::new();
    for c in path.to_string_lossy().chars() {
        match c {
            ' ' | '#' => {
                let before = escaped.chars().rev().take_while(|c| *c == '\\').count();
                escaped.push_str(&"\\".repeat(before + 1));
            }
            '$' => escaped.push('$'),
            _ => {}
        }
        escaped.push(c);
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_escaped_as_make_reads_them() {
        let rule = rule(
            Path::new("out/a b.spv"),
            [Path::new("x#1.wgsl"), Path::new("$y\\ z.toml")],
        );
        assert_eq!(rule, "out/a\\ b.spv: \\\n  x\\#1.wgsl \\\n  $$y\\\\\\ z.toml\n");
    }
}
