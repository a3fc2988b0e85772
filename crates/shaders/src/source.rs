//! One source file: its text, its syntax, and what it imports.
//!
//! WESL keeps no positions for imports, so they are found again in the text, with comments blanked out.

use std::ops::Range;

use wesl::ModulePath;
use wesl::syntax::{GlobalDeclaration, Import, ImportContent, PathOrigin, Statement, TranslationUnit};

use crate::error::{Error, SourceError};
use crate::features;

/// A parsed source file.
#[derive(Debug)]
pub(crate) struct Source {
    /// What messages call it.
    pub(crate) file: String,
    pub(crate) text: String,
    /// The text with comments replaced by spaces, byte for byte.
    code: String,
    pub(crate) syntax: TranslationUnit,
}

/// One imported name.
#[derive(Clone, Debug)]
pub(crate) struct Imported {
    /// The module, absolute.
    pub(crate) module: ModulePath,
    /// The name of the declaration there.
    pub(crate) item: String,
    /// Whether it goes by another name here.
    pub(crate) renamed: bool,
}

impl Source {
    pub(crate) fn parse(file: &str, text: &str) -> Result<Self, Error> {
        let syntax = text
            .parse::<TranslationUnit>()
            .map_err(|error| SourceError::at(error.error.to_string(), file, text, error.span.range()))?;
        Ok(Source {
            file: file.to_owned(),
            text: text.to_owned(),
            code: without_comments(text),
            syntax,
        })
    }

    /// The names of its module-scope declarations.
    pub(crate) fn declared(&self) -> impl Iterator<Item = String> {
        self.syntax
            .global_declarations
            .iter()
            .filter_map(|declaration| declared_name(declaration.node()))
    }

    /// The names of its functions, in order.
    pub(crate) fn functions(&self) -> Vec<String> {
        let functions = self
            .syntax
            .global_declarations
            .iter()
            .filter(|it| matches!(it.node(), GlobalDeclaration::Function(_)));
        functions
            .filter_map(|declaration| declared_name(declaration.node()))
            .collect()
    }

    /// The names of the functions that take a texture.
    pub(crate) fn texture_functions(&self) -> Vec<String> {
        let takes = |function: &wesl::syntax::Function| {
            function
                .parameters
                .iter()
                .any(|parameter| parameter.ty.to_string().starts_with("texture_"))
        };
        let names = self
            .syntax
            .global_declarations
            .iter()
            .filter_map(|it| match it.node() {
                GlobalDeclaration::Function(function) if takes(function) => declared_name(it.node()),
                _ => None,
            });
        names.collect()
    }

    /// What it imports, with paths made absolute from `here`.
    pub(crate) fn imports(&self, here: &ModulePath) -> Vec<Imported> {
        let mut found = Vec::new();
        for statement in &self.syntax.imports {
            match &statement.path {
                Some(path) => flatten(&statement.content, here.join_path(path), &mut found),
                None => flatten_packages(&statement.content, &mut found),
            }
        }
        found
    }

    /// The names of parameters and local variables.
    pub(crate) fn locals(&self) -> Vec<String> {
        let mut names = Vec::new();
        for declaration in &self.syntax.global_declarations {
            let GlobalDeclaration::Function(function) = declaration.node() else {
                continue;
            };
            names.extend(
                function
                    .parameters
                    .iter()
                    .map(|parameter| parameter.ident.to_string()),
            );
            for statement in features::statements(&function.body) {
                if let Statement::Declaration(local) = statement {
                    names.push(local.ident.to_string());
                }
            }
        }
        names
    }

    /// The last names of paths written inside of code, as `area` in `package::lib::shapes::area(x)`.
    pub(crate) fn inline_path_items(&self) -> Vec<(String, Range<usize>)> {
        let mut outside = self.code.clone().into_bytes();
        for statement in import_statements(&self.code) {
            outside[statement].fill(b' ');
        }
        let outside = String::from_utf8_lossy(&outside).into_owned();
        let mut found = Vec::new();
        for (at, _) in outside.match_indices("::") {
            let name: String = outside[at + 2..].chars().take_while(|c| is_word(*c)).collect();
            if !outside[at + 2 + name.len()..].starts_with("::") {
                found.push((name.clone(), at + 2..at + 2 + name.len()));
            }
        }
        found
    }

    /// A fault at a word of an import statement, or of the whole file where the word does not occur.
    pub(crate) fn fault_at_import(&self, word: &str, message: String) -> SourceError {
        let place = import_statements(&self.code).into_iter().find_map(|statement| {
            let start = find_word(&self.code[statement.clone()], word)?;
            Some(statement.start + start..statement.start + start + word.len())
        });
        match place {
            Some(range) => SourceError::at(message, &self.file, &self.text, range),
            None => SourceError::in_file(message, &self.file),
        }
    }

    /// A fault at the first occurrence of a word in the code, or of the whole file.
    pub(crate) fn fault_at_word(&self, word: &str, message: String) -> SourceError {
        match find_word(&self.code, word) {
            Some(start) => SourceError::at(message, &self.file, &self.text, start..start + word.len()),
            None => SourceError::in_file(message, &self.file),
        }
    }
}

/// The name that a module-scope declaration declares.
pub(crate) fn declared_name(declaration: &GlobalDeclaration) -> Option<String> {
    match declaration {
        GlobalDeclaration::Void | GlobalDeclaration::ConstAssert(_) => None,
        GlobalDeclaration::Declaration(it) => Some(it.ident.to_string()),
        GlobalDeclaration::TypeAlias(it) => Some(it.ident.to_string()),
        GlobalDeclaration::Struct(it) => Some(it.ident.to_string()),
        GlobalDeclaration::Function(it) => Some(it.ident.to_string()),
    }
}

fn flatten(content: &ImportContent, module: ModulePath, found: &mut Vec<Imported>) {
    match content {
        ImportContent::Item(item) => {
            found.push(Imported {
                module,
                item: item.ident.to_string(),
                renamed: item.rename.is_some(),
            });
        }
        ImportContent::Collection(imports) => {
            for import in imports {
                flatten(
                    &import.content,
                    module.clone().join(import.path.iter().cloned()),
                    found,
                );
            }
        }
    }
}

/// `import {foo::bar, …}`: the first word of each is a package.
fn flatten_packages(content: &ImportContent, found: &mut Vec<Imported>) {
    let ImportContent::Collection(imports) = content else {
        return;
    };
    for Import { path, content } in imports {
        let mut components = path.iter().cloned();
        if let Some(package) = components.next() {
            flatten(
                content,
                ModulePath::new(PathOrigin::Package(package), components.collect()),
                found,
            );
        }
    }
}

/// The text with line and (nested) block comments replaced by spaces; line breaks stay.
fn without_comments(text: &str) -> String {
    let bytes = text.as_bytes();
    let mut code = bytes.to_vec();
    let (mut at, mut depth) = (0, 0_usize);
    while at < bytes.len() {
        let pair = &bytes[at..bytes.len().min(at + 2)];
        let length = match pair {
            b"//" if depth == 0 => bytes[at..]
                .iter()
                .position(|b| *b == b'\n')
                .unwrap_or(bytes.len() - at),
            b"/*" => {
                depth += 1;
                2
            }
            b"*/" if depth > 0 => {
                depth -= 1;
                code[at..at + 2].fill(b' ');
                at += 2;
                continue;
            }
            _ => 1,
        };
        if depth > 0 || pair == b"//" {
            code[at..at + length]
                .iter_mut()
                .filter(|b| **b != b'\n')
                .for_each(|b| *b = b' ');
        }
        at += length;
    }
    String::from_utf8_lossy(&code).into_owned()
}

/// The byte ranges of `import …;`.
fn import_statements(code: &str) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut from = 0;
    while let Some(start) = find_word(&code[from..], "import") {
        let start = from + start;
        let end = code[start..]
            .find(';')
            .map_or(code.len(), |length| start + length + 1);
        found.push(start..end);
        from = end;
    }
    found
}

fn find_word(code: &str, word: &str) -> Option<usize> {
    code.match_indices(word).map(|(at, _)| at).find(|&at| {
        let before = code[..at].chars().next_back();
        let after = code[at + word.len()..].chars().next();
        !before.is_some_and(is_word) && !after.is_some_and(is_word)
    })
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

#[cfg(test)]
mod tests {
    use super::{Source, find_word, without_comments};

    #[test]
    fn comments_are_blanked_and_places_kept() {
        let text = "a // import x;\nb /* c /* d */ ö\n */ e / f";
        let code = without_comments(text);
        assert_eq!(code.len(), text.len());
        assert_eq!(
            code.split_whitespace().collect::<Vec<_>>(),
            ["a", "b", "e", "/", "f"]
        );
        assert_eq!(code.matches('\n').count(), 2);
    }

    #[test]
    fn words_are_whole() {
        assert_eq!(find_word("normalise_published normalise", "normalise"), Some(20));
        assert_eq!(find_word("normalised", "normalise"), None);
    }

    #[test]
    fn inline_paths_give_their_last_name() -> Result<(), crate::Error> {
        let text =
            "import package::a::b;\n// c::d\nfn f() -> f32 { return package::lib::shapes::area(1.0); }";
        let source = Source::parse("x.wesl", text)?;
        let names: Vec<String> = source
            .inline_path_items()
            .into_iter()
            .map(|(name, _)| name)
            .collect();
        assert_eq!(names, ["area"]);
        Ok(())
    }
}
