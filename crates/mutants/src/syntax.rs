//! A walk over a source file's expressions and statements, each with its true place in the text.
//!
//! Places are the parser's, with one correction: the parser's place of what stands before a `.component` or `[index]` runs on
//! to the end of the component or index (`a` in `a.xy` is placed at `a.xy`). Types, attributes, parameters and imports are not
//! walked: what is declared is not what is computed.

use std::ops::Range;

use wesl::syntax::{
    CaseSelector, CompoundStatement, Declaration, Expression, ExpressionNode, ForStatement,
    GlobalDeclaration, IfStatement, LoopStatement, NamedComponentExpression, Statement, StatementNode,
    SwitchStatement, TranslationUnit,
};

use crate::error::Error;

/// What a walk meets.
#[derive(Clone, Debug)]
pub enum Node<'a> {
    /// An expression.
    Expression {
        /// Its syntax.
        syntax: &'a Expression,
        /// Its place.
        range: Range<usize>,
    },
    /// A statement.
    Statement {
        /// Its syntax.
        syntax: &'a Statement,
        /// Its place, without the attributes before it.
        range: Range<usize>,
        /// Whether it stands in the head of a `for`.
        in_head: bool,
    },
}

/// A parsed file.
#[derive(Debug)]
pub struct File {
    syntax: TranslationUnit,
    text: String,
}

impl File {
    /// Parses a file; `name` is what a message calls it.
    ///
    /// # Errors
    /// [`Error::Syntax`].
    pub fn parse(name: &str, text: &str) -> Result<Self, Error> {
        let syntax = text.parse::<TranslationUnit>().map_err(|error| Error::Syntax {
            file: name.to_owned(),
            line: text[..error.span.start.min(text.len())].matches('\n').count() + 1,
            message: error.error.to_string(),
        })?;
        Ok(Self {
            syntax,
            text: text.to_owned(),
        })
    }

    /// Every node of every function body and every module-scope value, with the name of the function or value. In the order of
    /// the text, outer before inner.
    pub fn walk<'a>(&'a self, see: &mut dyn FnMut(&str, Node<'a>)) {
        for declaration in &self.syntax.global_declarations {
            match declaration.node() {
                GlobalDeclaration::Function(function) => {
                    let name = function.ident.to_string();
                    let mut walk = Walk {
                        text: &self.text,
                        see: &mut |node| see(&name, node),
                    };
                    walk.compound(&function.body);
                }
                GlobalDeclaration::Declaration(value) => {
                    let name = value.ident.to_string();
                    let mut walk = Walk {
                        text: &self.text,
                        see: &mut |node| see(&name, node),
                    };
                    walk.declaration(value);
                }
                GlobalDeclaration::Void
                | GlobalDeclaration::TypeAlias(_)
                | GlobalDeclaration::Struct(_)
                | GlobalDeclaration::ConstAssert(_) => {}
            }
        }
    }
}

/// A component of a vector or structure: its place in the text.
#[must_use]
pub fn component_range(component: &NamedComponentExpression) -> Range<usize> {
    let end = component.base.span().end;
    end - component.component.name().len()..end
}

struct Walk<'a, 's> {
    text: &'a str,
    see: &'s mut dyn FnMut(Node<'a>),
}

impl<'a> Walk<'a, '_> {
    fn compound(&mut self, body: &'a CompoundStatement) {
        body.statements
            .iter()
            .for_each(|statement| self.statement(statement, false));
    }

    fn statement(&mut self, node: &'a StatementNode, in_head: bool) {
        let syntax = node.node();
        let span = node.span();
        let attributes_end = attributes_end(syntax);
        let range = attributes_end.map_or(span.start, |end| skip_space(self.text, end))..span.end;
        (self.see)(Node::Statement {
            syntax,
            range,
            in_head,
        });
        match syntax {
            Statement::Void | Statement::Break(_) | Statement::Continue(_) | Statement::Discard(_) => {}
            Statement::Compound(it) => self.compound(it),
            Statement::Assignment(it) => [&it.lhs, &it.rhs].into_iter().for_each(|e| self.whole(e)),
            Statement::Increment(it) => self.whole(&it.expression),
            Statement::Decrement(it) => self.whole(&it.expression),
            Statement::If(it) => self.branches(it),
            Statement::Switch(it) => self.switch(it),
            Statement::Loop(it) => self.endless(it),
            Statement::For(it) => self.counted(it),
            Statement::While(it) => {
                self.whole(&it.condition);
                self.compound(&it.body);
            }
            Statement::Return(it) => it.expression.iter().for_each(|e| self.whole(e)),
            Statement::FunctionCall(it) => it.call.arguments.iter().for_each(|e| self.whole(e)),
            Statement::ConstAssert(_) => {}
            Statement::Declaration(it) => self.declaration(it),
        }
    }

    fn declaration(&mut self, declaration: &'a Declaration) {
        declaration.initializer.iter().for_each(|e| self.whole(e));
    }

    fn branches(&mut self, it: &'a IfStatement) {
        self.whole(&it.if_clause.expression);
        self.compound(&it.if_clause.body);
        for clause in &it.else_if_clauses {
            self.whole(&clause.expression);
            self.compound(&clause.body);
        }
        it.else_clause
            .iter()
            .for_each(|clause| self.compound(&clause.body));
    }

    fn switch(&mut self, it: &'a SwitchStatement) {
        self.whole(&it.expression);
        for clause in &it.clauses {
            for selector in &clause.case_selectors {
                match selector {
                    CaseSelector::Default => {}
                    CaseSelector::Expression(e) => self.whole(e),
                }
            }
            self.compound(&clause.body);
        }
    }

    fn endless(&mut self, it: &'a LoopStatement) {
        self.compound(&it.body);
        if let Some(continuing) = &it.continuing {
            self.compound(&continuing.body);
            continuing
                .break_if
                .iter()
                .for_each(|it| self.whole(&it.expression));
        }
    }

    fn counted(&mut self, it: &'a ForStatement) {
        it.initializer.iter().for_each(|s| self.statement(s, true));
        it.condition.iter().for_each(|e| self.whole(e));
        it.update.iter().for_each(|s| self.statement(s, true));
        self.compound(&it.body);
    }

    /// An expression whose place the parser gives right.
    fn whole(&mut self, node: &'a ExpressionNode) {
        self.expression(node.node(), node.span().range());
    }

    fn expression(&mut self, syntax: &'a Expression, range: Range<usize>) {
        let start = range.start;
        (self.see)(Node::Expression { syntax, range });
        match syntax {
            Expression::Literal(_) | Expression::TypeOrIdentifier(_) => {}
            Expression::Parenthesized(it) => self.whole(&it.expression),
            Expression::NamedComponent(it) => {
                let dot = self.text[..component_range(it).start]
                    .trim_end()
                    .len()
                    .saturating_sub(1);
                self.expression(it.base.node(), start..self.text[..dot].trim_end().len());
            }
            Expression::Indexing(it) => {
                let bracket = self.text[..it.index.span().start].rfind('[').unwrap_or(start);
                self.expression(it.base.node(), start..self.text[..bracket].trim_end().len());
                self.whole(&it.index);
            }
            Expression::Unary(it) => self.whole(&it.operand),
            Expression::Binary(it) => [&it.left, &it.right].into_iter().for_each(|e| self.whole(e)),
            Expression::FunctionCall(it) => it.arguments.iter().for_each(|e| self.whole(e)),
        }
    }
}

/// Where the attributes before a statement end, if it has any.
fn attributes_end(statement: &Statement) -> Option<usize> {
    let attributes = match statement {
        Statement::Void => return None,
        Statement::Compound(it) => &it.attributes,
        Statement::Assignment(it) => &it.attributes,
        Statement::Increment(it) => &it.attributes,
        Statement::Decrement(it) => &it.attributes,
        Statement::If(it) => &it.attributes,
        Statement::Switch(it) => &it.attributes,
        Statement::Loop(it) => &it.attributes,
        Statement::For(it) => &it.attributes,
        Statement::While(it) => &it.attributes,
        Statement::Break(it) => &it.attributes,
        Statement::Continue(it) => &it.attributes,
        Statement::Return(it) => &it.attributes,
        Statement::Discard(it) => &it.attributes,
        Statement::FunctionCall(it) => &it.attributes,
        Statement::ConstAssert(it) => &it.attributes,
        Statement::Declaration(it) => &it.attributes,
    };
    attributes.last().map(|attribute| attribute.span().end)
}

/// The place of the next thing that is neither space nor comment.
fn skip_space(text: &str, from: usize) -> usize {
    let mut at = from;
    loop {
        at += text[at..].len() - text[at..].trim_start().len();
        if !text[at..].starts_with("//") {
            return at;
        }
        at += text[at..].find('\n').unwrap_or(text.len() - at);
    }
}

#[cfg(test)]
mod tests {
    use super::{File, Node};

    fn seen(text: &str) -> Vec<(String, String)> {
        let file = File::parse("x.wesl", text).unwrap();
        let mut found = Vec::new();
        file.walk(&mut |item, node| {
            let range = match node {
                Node::Expression { range, .. } | Node::Statement { range, .. } => range,
            };
            found.push((item.to_owned(), text[range].to_owned()));
        });
        found
    }

    fn of<'a>(seen: &'a [(String, String)], item: &str) -> Vec<&'a str> {
        seen.iter()
            .filter(|(name, _)| name == item)
            .map(|(_, text)| text.as_str())
            .collect()
    }

    #[test]
    fn what_stands_before_a_component_ends_before_the_dot() {
        let seen = seen("fn f(m: mat3x3f) -> vec2f { return g(m)[0].zyx.xy; }");
        assert_eq!(
            of(&seen, "f"),
            [
                "return g(m)[0].zyx.xy;",
                "g(m)[0].zyx.xy",
                "g(m)[0].zyx",
                "g(m)[0]",
                "g(m)",
                "m",
                "0"
            ]
        );
    }

    #[test]
    fn a_statement_begins_after_its_attributes() {
        let text = "fn f() { @if(a && b)\n // why\n return; @else { x.y = 1; } }";
        assert_eq!(
            of(&seen(text), "f"),
            ["return;", "{ x.y = 1; }", "x.y = 1;", "x.y", "x", "1"]
        );
    }

    #[test]
    fn heads_of_loops_and_constants_are_walked_and_types_are_not() {
        let text = "const N: u32 = 4u; var<private> a: array<f32, 3>;\
                    @compute @workgroup_size(64) fn f() { for (var i = 0u; i < N; i++) { a[i] += 1.0; } }";
        let seen = seen(text);
        assert_eq!(of(&seen, "N"), ["4u"]);
        assert!(of(&seen, "a").is_empty());
        let f = of(&seen, "f");
        for part in ["var i = 0u", "i < N", "i++", "a[i] += 1.0;", "a[i]", "a", "1.0"] {
            assert!(f.contains(&part), "{part} is not in {f:?}");
        }
        assert!(!f.contains(&"64") && !f.contains(&"3"));
    }

    #[test]
    fn a_syntax_error_has_its_line() {
        let error = File::parse("x.wesl", "fn f() {\n  let = 1;\n}")
            .unwrap_err()
            .to_string();
        assert!(error.starts_with("x.wesl:2:"), "{error}");
    }
}
