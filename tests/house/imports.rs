//! What a module imports: by `use`, or by a path within code that begins with `crate`, `self` or `super`.

use super::sources::{Source, is_test};
use proc_macro2::{TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use syn::visit::{self, Visit};

/// A path from the root, without `crate`.
pub(crate) type Path = Vec<String>;

/// An import of one module by another.
pub(crate) struct Import {
    /// The module that imports.
    pub(crate) from: Path,
    /// What it names.
    pub(crate) named: Path,
    /// The module where that is defined.
    pub(crate) to: Path,
    place: String,
}

impl fmt::Display for Import {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} imports {}", self.place, self.named.join("::"))
    }
}

/// What all sources import of each other.
pub(crate) fn all(sources: &[Source]) -> Vec<Import> {
    let modules: BTreeSet<_> = sources.iter().map(|source| source.module.clone()).collect();
    let mut imports = Vec::new();
    let mut bound = BTreeMap::new();
    for source in sources {
        let mut finder = Finder {
            modules: &modules,
            module: source.module.clone(),
            found: Vec::new(),
        };
        finder.visit_file(&source.syntax);
        for (named, name, line) in finder.found {
            if let Some(name) = name {
                bound.insert([&source.module[..], &[name]].concat(), named.clone());
            }
            let place = format!("{}:{line}", source.file);
            imports.push(Import {
                from: source.module.clone(),
                to: Vec::new(),
                named,
                place,
            });
        }
    }
    for import in &mut imports {
        import.to = defined_in(&import.named, &bound, &modules);
    }
    imports
}

/// The module that defines what is at this path, through what modules re-export.
fn defined_in(named: &Path, bound: &BTreeMap<Path, Path>, modules: &BTreeSet<Path>) -> Path {
    let mut path = named.clone();
    for _ in 0..8 {
        let length = (0..=path.len())
            .rev()
            .find(|&length| modules.contains(&path[..length]))
            .unwrap_or(0);
        let again = path.get(..=length).and_then(|name| bound.get(name));
        match again {
            Some(again) if *again != path => path = [&again[..], &path[length + 1..]].concat(),
            _ => {
                path.truncate(length);
                break;
            }
        }
    }
    path
}

/// Finds the paths of one file.
struct Finder<'a> {
    modules: &'a BTreeSet<Path>,
    module: Path,
    /// The path, the name that `use` binds it to, the line.
    found: Vec<(Path, Option<String>, usize)>,
}

impl Finder<'_> {
    /// The path from the root of words that begin with `crate`, `self`, `super` or the name of a module beside.
    fn absolute(&self, words: &[String]) -> Option<Path> {
        let mut path = self.module.clone();
        let mut rest = words;
        match rest.first()?.as_str() {
            "crate" | "svbench" => path.clear(),
            "self" | "super" => {}
            first => {
                path.push(first.to_owned());
                return self
                    .modules
                    .contains(&path)
                    .then(|| [&self.module[..], words].concat());
            }
        }
        while let Some(word) = rest.first() {
            match word.as_str() {
                "crate" | "self" | "svbench" => {}
                "super" => _ = path.pop(),
                _ => break,
            }
            rest = &rest[1..];
        }
        Some([&path[..], rest].concat())
    }

    fn add(&mut self, words: &[String], name: Option<String>, line: usize) {
        if let Some(path) = self.absolute(words) {
            self.found.push((path, name, line));
        }
    }

    fn add_tree(&mut self, tree: &syn::UseTree, words: &[String]) {
        let mut add = |ident: &syn::Ident, name: &syn::Ident| {
            let words = if ident == "self" {
                words.to_vec()
            } else {
                [words, &[ident.to_string()]].concat()
            };
            let name = if name == "self" {
                words.last().cloned()
            } else {
                Some(name.to_string())
            };
            self.add(&words, name, ident.span().start().line);
        };
        match tree {
            syn::UseTree::Path(path) => {
                self.add_tree(&path.tree, &[words, &[path.ident.to_string()]].concat());
            }
            syn::UseTree::Name(tree) => add(&tree.ident, &tree.ident),
            syn::UseTree::Rename(tree) => add(&tree.ident, &tree.rename),
            syn::UseTree::Glob(glob) => {
                self.add(words, None, glob.star_token.spans[0].start().line);
            }
            syn::UseTree::Group(group) => group
                .items
                .iter()
                .for_each(|tree| self.add_tree(tree, words)),
        }
    }

    /// Paths within a macro's tokens.
    fn add_tokens(&mut self, tokens: TokenStream) {
        let tokens: Vec<_> = tokens.into_iter().collect();
        let is_colon = |at: usize| matches!(tokens.get(at), Some(TokenTree::Punct(mark)) if mark.as_char() == ':');
        let mut at = 0;
        while at < tokens.len() {
            match &tokens[at] {
                TokenTree::Group(group) => self.add_tokens(group.stream()),
                TokenTree::Ident(first) => {
                    let line = first.span().start().line;
                    let mut words = vec![first.to_string()];
                    while let (true, true, Some(TokenTree::Ident(next))) =
                        (is_colon(at + 1), is_colon(at + 2), tokens.get(at + 3))
                    {
                        words.push(next.to_string());
                        at += 3;
                    }
                    if words.len() > 1 {
                        self.add(&words, None, line);
                    }
                }
                _ => {}
            }
            at += 1;
        }
    }
}

impl<'ast> Visit<'ast> for Finder<'_> {
    fn visit_item(&mut self, item: &'ast syn::Item) {
        let attributes = match item {
            syn::Item::Mod(item) => &item.attrs,
            syn::Item::Use(item) => &item.attrs,
            syn::Item::Fn(item) => &item.attrs,
            syn::Item::Impl(item) => &item.attrs,
            _ => return visit::visit_item(self, item),
        };
        if !is_test(attributes) {
            visit::visit_item(self, item);
        }
    }

    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        self.module.push(item.ident.to_string());
        visit::visit_item_mod(self, item);
        self.module.pop();
    }

    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        self.add_tree(&item.tree, &[]);
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let words: Vec<_> = path
            .segments
            .iter()
            .map(|segment| segment.ident.to_string())
            .collect();
        if words.len() > 1 {
            let line = path.segments[0].ident.span().start().line;
            self.add(&words, None, line);
        }
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, call: &'ast syn::Macro) {
        self.add_tokens(call.tokens.clone());
        visit::visit_macro(self, call);
    }

    fn visit_visibility(&mut self, _: &'ast syn::Visibility) {}
}
