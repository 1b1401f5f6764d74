//! Where a source file can be changed, and into what.

use std::ops::Range;

use proc_macro2::Span;
use serde::{Deserialize, Serialize};
use syn::{
    Attribute, BinOp, Block, Expr, ExprBinary, ExprMethodCall, ExprUnary, ImplItemFn, ItemConst, ItemFn, ItemMod,
    ItemStatic, ReturnType, Type, UnOp, spanned::Spanned, visit::Visit,
};

/// A change of one expression or of one function.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Site {
    /// Path below the workspace.
    pub file: String,
    pub line: usize,
    /// Bytes of the expression, or the empty place behind the brace that opens a function.
    pub place: Range<usize>,
    /// The bytes that are replaced within `place`; empty for a function.
    pub word: Range<usize>,
    /// What stands there instead; for a function, what it gives back at once.
    pub instead: String,
    /// In words.
    pub what: String,
}

/// All changes of a file.
pub fn sites(file: &str, text: &str) -> syn::Result<Vec<Site>> {
    let mut found = Found { file, text, sites: Vec::new(), function: String::new() };
    found.visit_file(&syn::parse_file(text)?);
    Ok(found.sites)
}

struct Found<'a> {
    file: &'a str,
    text: &'a str,
    sites: Vec<Site>,
    function: String,
}

impl Found<'_> {
    fn add(&mut self, place: Range<usize>, word: Range<usize>, line: usize, instead: &str) {
        let what = if word.is_empty() {
            format!("`{}` gives {} at once", self.function, if instead.is_empty() { "()" } else { instead })
        } else {
            let was = &self.text[word.clone()];
            let by = if instead.is_empty() { "nothing" } else { instead };
            format!("`{was}` -> `{by}` in `{}`: `{}`", self.function, short(&self.text[place.clone()]))
        };
        self.sites.push(Site { file: self.file.into(), line, place, word, instead: instead.into(), what });
    }

    fn word(&mut self, whole: Span, word: Span, instead: &str) {
        self.add(whole.byte_range(), word.byte_range(), word.start().line, instead);
    }

    fn function(&mut self, output: &ReturnType, block: &Block, name: String) {
        self.function = name;
        let inside = block.brace_token.span.open().byte_range().end;
        let line = block.span().start().line;
        // A function of one word is as good as its value; an empty one has nothing to lose.
        if block.stmts.is_empty() {
            return;
        }
        for value in values(output) {
            self.add(inside..inside, inside..inside, line, value);
        }
    }
}

/// On one line, and not longer than a reader wants.
fn short(text: &str) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    if line.chars().count() > 90 { line.chars().take(87).chain("...".chars()).collect() } else { line }
}

/// Values that a function of this type could give without looking at anything.
fn values(output: &ReturnType) -> Vec<&'static str> {
    let ReturnType::Type(_, of) = output else { return vec![""] };
    let Type::Path(path) = &**of else { return vec![] };
    let Some(last) = path.path.segments.last() else { return vec![] };
    match last.ident.to_string().as_str() {
        "f64" => vec!["0.0", "1.0"],
        "bool" => vec!["true", "false"],
        "usize" | "u32" | "u64" | "i32" | "i64" => vec!["0", "1"],
        "Option" => vec!["None"],
        "Vec" => vec!["Vec::new()"],
        "Result" if unit(last) => vec!["Ok(())"],
        _ => vec![],
    }
}

/// `Result<(), _>`.
fn unit(result: &syn::PathSegment) -> bool {
    let syn::PathArguments::AngleBracketed(of) = &result.arguments else { return false };
    matches!(of.args.first(), Some(syn::GenericArgument::Type(Type::Tuple(t))) if t.elems.is_empty())
}

fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|a| {
        a.path().is_ident("test")
            || (a.path().is_ident("cfg") && a.parse_args::<syn::Path>().is_ok_and(|p| p.is_ident("test")))
    })
}

/// Whether `let` stands in a condition: no value, and `||` means nothing to it.
fn binds(e: &Expr) -> bool {
    match e {
        Expr::Let(_) => true,
        Expr::Binary(b) => binds(&b.left) || binds(&b.right),
        _ => false,
    }
}

impl<'a> Visit<'a> for Found<'_> {
    fn visit_item_mod(&mut self, item: &'a ItemMod) {
        if !is_test(&item.attrs) {
            syn::visit::visit_item_mod(self, item);
        }
    }

    // Nothing is chosen while the program is compiled.
    fn visit_item_const(&mut self, _: &'a ItemConst) {}
    fn visit_impl_item_const(&mut self, _: &'a syn::ImplItemConst) {}
    fn visit_item_static(&mut self, _: &'a ItemStatic) {}
    fn visit_expr_repeat(&mut self, e: &'a syn::ExprRepeat) {
        self.visit_expr(&e.expr);
    }
    fn visit_type_array(&mut self, _: &'a syn::TypeArray) {}
    fn visit_pat(&mut self, _: &'a syn::Pat) {}

    fn visit_item_fn(&mut self, item: &'a ItemFn) {
        if !is_test(&item.attrs) && item.sig.constness.is_none() {
            self.function(&item.sig.output, &item.block, item.sig.ident.to_string());
            syn::visit::visit_block(self, &item.block);
        }
    }

    fn visit_impl_item_fn(&mut self, item: &'a ImplItemFn) {
        if item.sig.constness.is_none() {
            self.function(&item.sig.output, &item.block, item.sig.ident.to_string());
            syn::visit::visit_block(self, &item.block);
        }
    }

    fn visit_expr_binary(&mut self, e: &'a ExprBinary) {
        let instead = match e.op {
            BinOp::Add(_) => "-",
            BinOp::Sub(_) => "+",
            BinOp::Mul(_) => "/",
            BinOp::Div(_) => "*",
            BinOp::Rem(_) => "*",
            BinOp::AddAssign(_) => "-=",
            BinOp::SubAssign(_) => "+=",
            BinOp::MulAssign(_) => "/=",
            BinOp::DivAssign(_) => "*=",
            BinOp::And(_) if !binds(&e.left) && !binds(&e.right) => "||",
            BinOp::Or(_) => "&&",
            BinOp::Lt(_) | BinOp::Le(_) => ">",
            BinOp::Gt(_) | BinOp::Ge(_) => "<",
            BinOp::Eq(_) => "!=",
            BinOp::Ne(_) => "==",
            _ => "",
        };
        if !instead.is_empty() {
            self.word(e.span(), e.op.span(), instead);
        }
        syn::visit::visit_expr_binary(self, e);
    }

    fn visit_expr_unary(&mut self, e: &'a ExprUnary) {
        let literal = matches!(&*e.expr, Expr::Lit(_));
        if matches!(e.op, UnOp::Not(_)) || (matches!(e.op, UnOp::Neg(_)) && !literal) {
            self.word(e.span(), e.op.span(), "");
        }
        syn::visit::visit_expr_unary(self, e);
    }

    fn visit_expr_method_call(&mut self, e: &'a ExprMethodCall) {
        let instead = match e.method.to_string().as_str() {
            "min" if e.args.len() == 1 => "max",
            "max" if e.args.len() == 1 => "min",
            "sin" => "cos",
            "cos" => "sin",
            "any" => "all",
            "all" => "any",
            _ => "",
        };
        if !instead.is_empty() {
            self.word(e.span(), e.method.span(), instead);
        }
        syn::visit::visit_expr_method_call(self, e);
    }
}
