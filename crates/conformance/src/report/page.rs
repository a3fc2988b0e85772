//! The frame of every page that the tools write: one file, nothing from elsewhere, light or dark as its reader likes it.
//!
//! Its policy forbids the browser to fetch anything but what the file holds, so a page that forgot this shows a hole and not somebody
//! else's picture.

use maud::{DOCTYPE, Markup, PreEscaped, html};

const STYLE: &str = include_str!("page.css");

/// What is put into the frame.
#[derive(Clone, Debug)]
pub struct Page<'a> {
    /// Title and main heading.
    pub title: &'a str,
    /// Rules of its own, after those of all pages.
    pub style: &'a str,
    /// Identifiers and names of its parts, for a list of links; may be empty.
    pub parts: &'a [(&'a str, &'a str)],
    /// The content.
    pub main: Markup,
    /// A script that runs when all of it is there; may be empty.
    pub script: &'a str,
}

impl Page<'_> {
    /// The whole file.
    #[must_use]
    pub fn write(&self) -> String {
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    meta name="color-scheme" content="light dark";
                    meta http-equiv="Content-Security-Policy" content=(self.policy());
                    title { (self.title) }
                    style { (PreEscaped(STYLE)) (PreEscaped(self.style)) }
                }
                body {
                    a.skip-link href="#main" { "Skip to the content" }
                    header { h1 { (self.title) } (self.contents()) }
                    main id="main" { (self.main) }
                    @if !self.script.is_empty() { script { (PreEscaped(self.script)) } }
                }
            }
        };
        page.into_string()
    }

    fn policy(&self) -> String {
        let scripts = if self.script.is_empty() {
            "'none'"
        } else {
            "'unsafe-inline'"
        };
        format!("default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src {scripts}")
    }

    fn contents(&self) -> Markup {
        html! {
            @if !self.parts.is_empty() {
                nav aria-label="Parts of this page" {
                    ul { @for (id, name) in self.parts { li { a href={ "#" (id) } { (name) } } } }
                }
            }
        }
    }
}
