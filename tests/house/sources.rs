//! The files of `src`, parsed; `#[cfg(test)]` is left out.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use syn::spanned::Spanned;
use syn::visit::{self, Visit};

/// A file that is compiled outside of tests.
pub(crate) struct Source {
    /// Its path from the root of the repository.
    pub(crate) file: String,
    /// Its module, without `crate`: empty for `lib.rs` and `main.rs`.
    pub(crate) module: Vec<String>,
    pub(crate) syntax: syn::File,
    lines: usize,
}

/// A function with a body.
pub(crate) struct Function {
    pub(crate) name: String,
    pub(crate) line: usize,
    pub(crate) lines: usize,
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

/// Names of the folders of `src`.
pub(crate) fn folders() -> BTreeSet<String> {
    let entries = fs::read_dir(root()).unwrap().map(Result::unwrap);
    let folders = entries.filter(|entry| entry.file_type().unwrap().is_dir());
    folders
        .map(|entry| entry.file_name().into_string().unwrap())
        .collect()
}

/// Every Rust file of `src`, tests too, with its text.
pub(crate) fn all_files() -> Vec<(String, String)> {
    let mut files = Vec::new();
    let mut folders = vec![root()];
    while let Some(folder) = folders.pop() {
        for path in fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().path())
        {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push((shown(&path), fs::read_to_string(&path).unwrap()));
            }
        }
    }
    files
}

fn shown(path: &Path) -> String {
    path.strip_prefix(env!("CARGO_MANIFEST_DIR"))
        .unwrap()
        .display()
        .to_string()
}

/// The files that `lib.rs` and `main.rs` lead to by `mod`, but for those of tests.
pub(crate) fn sources() -> Vec<Source> {
    let mut sources = Vec::new();
    for name in ["lib.rs", "main.rs"] {
        read(&root().join(name), &[], &mut sources);
    }
    sources
}

fn read(path: &Path, module: &[String], sources: &mut Vec<Source>) {
    let text =
        fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let syntax =
        syn::parse_file(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let declared: Vec<_> = syntax
        .items
        .iter()
        .filter_map(|item| match item {
            syn::Item::Mod(item) if item.content.is_none() && !is_test(&item.attrs) => {
                Some(item.ident.to_string())
            }
            _ => None,
        })
        .collect();
    let stem = path.file_stem().unwrap();
    let is_face = ["lib", "main", "mod"].iter().any(|&face| stem == face);
    let folder = if is_face {
        path.parent().unwrap().to_owned()
    } else {
        path.with_extension("")
    };
    sources.push(Source {
        file: shown(path),
        module: module.to_owned(),
        syntax,
        lines: text.lines().count(),
    });
    for name in declared {
        let [file, face] = [
            folder.join(format!("{name}.rs")),
            folder.join(&name).join("mod.rs"),
        ];
        let child = [module, &[name]].concat();
        read(if file.exists() { &file } else { &face }, &child, sources);
    }
}

/// Whether a thing is only there for tests.
pub(crate) fn is_test(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let is_cfg = attribute.path().is_ident("cfg");
        is_cfg
            && attribute
                .parse_args::<syn::Ident>()
                .is_ok_and(|word| word == "test")
    })
}

impl Source {
    /// Lines, without those of test modules within.
    pub(crate) fn code_lines(&self) -> usize {
        let tests = self.syntax.items.iter().filter_map(|item| match item {
            syn::Item::Mod(item) if is_test(&item.attrs) => Some(lines(item.span())),
            _ => None,
        });
        self.lines - tests.sum::<usize>()
    }

    /// Where it says `unsafe`.
    pub(crate) fn unsafe_lines(&self) -> Vec<String> {
        let mut finder = Unsafe(Vec::new());
        finder.visit_file(&self.syntax);
        finder
            .0
            .iter()
            .map(|line| format!("{}:{line}", self.file))
            .collect()
    }

    /// All functions, in tests too, without what stands above their names.
    pub(crate) fn functions(&self) -> Vec<Function> {
        let mut finder = Functions(Vec::new());
        finder.visit_file(&self.syntax);
        finder.0
    }
}

fn lines(span: proc_macro2::Span) -> usize {
    span.end().line - span.start().line + 1
}

struct Unsafe(Vec<usize>);

impl<'ast> Visit<'ast> for Unsafe {
    fn visit_expr_unsafe(&mut self, block: &'ast syn::ExprUnsafe) {
        self.0.push(block.span().start().line);
    }

    fn visit_item_impl(&mut self, item: &'ast syn::ItemImpl) {
        if let Some(word) = &item.unsafety {
            self.0.push(word.span().start().line);
        }
        visit::visit_item_impl(self, item);
    }
}

struct Functions(Vec<Function>);

impl Functions {
    fn add(&mut self, signature: &syn::Signature, body: &syn::Block) {
        let line = signature.span().start().line;
        let lines = body.span().end().line - line + 1;
        self.0.push(Function {
            name: signature.ident.to_string(),
            line,
            lines,
        });
    }
}

impl<'ast> Visit<'ast> for Functions {
    fn visit_item_fn(&mut self, item: &'ast syn::ItemFn) {
        self.add(&item.sig, &item.block);
        visit::visit_item_fn(self, item);
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        self.add(&item.sig, &item.block);
        visit::visit_impl_item_fn(self, item);
    }

    fn visit_trait_item_fn(&mut self, item: &'ast syn::TraitItemFn) {
        if let Some(body) = &item.default {
            self.add(&item.sig, body);
        }
        visit::visit_trait_item_fn(self, item);
    }
}
