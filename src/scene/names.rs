//! Names of bodies and of generators' nodes, and what they stand for.

use super::error::{Fault, Problem, shown};
use super::nearest::nearest;
use crate::engine::Id;
use std::collections::BTreeMap;

/// How a generator's nodes are numbered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Layout {
    /// `name.0` to `name.(n − 1)`.
    Line(usize),
    /// `name.column.row`, row by row from the top.
    Grid {
        /// Nodes in a row.
        columns: usize,
        /// Nodes in a column.
        rows: usize,
    },
}

impl Layout {
    /// Place of the node behind `name.` among the generator's nodes.
    fn index_of(&self, node: &str) -> Option<usize> {
        let mut numbers = node.split('.').map(|number| number.parse::<usize>().ok());
        let index = match *self {
            Layout::Line(count) => numbers.next()?.filter(|index| *index < count)?,
            Layout::Grid { columns, rows } => {
                let column = numbers.next()?.filter(|column| *column < columns)?;
                let row = numbers.next()?.filter(|row| *row < rows)?;
                row * columns + column
            }
        };
        numbers.next().is_none().then_some(index)
    }

    /// A node's place as part of a body's own name, in which dots have no place: "12", or "3_4" for column and row.
    fn own(&self, index: usize) -> String {
        match *self {
            Layout::Line(_) => index.to_string(),
            Layout::Grid { columns, .. } => format!("{}_{}", index % columns, index / columns),
        }
    }

    fn count(&self) -> usize {
        match *self {
            Layout::Line(count) => count,
            Layout::Grid { columns, rows } => columns * rows,
        }
    }

    /// The nodes as a user may name them.
    fn describe(&self, name: &str) -> String {
        let name = shown(name);
        match *self {
            Layout::Line(count) => format!("{name}.0 to {name}.{}", count - 1),
            Layout::Grid { columns, rows } => format!("{name}.0.0 to {name}.{}.{}", columns - 1, rows - 1),
        }
    }
}

/// What a name stands for: dense indices of bodies.
#[derive(Clone, Copy, Debug)]
enum Named {
    Body(usize),
    Nodes { first: usize, layout: Layout },
}

/// All names of a scene.
#[derive(Clone, Debug, Default)]
pub(crate) struct Names {
    named: BTreeMap<String, Named>,
}

impl Names {
    /// Names body `index`.
    pub(crate) fn add_body(&mut self, name: &str, index: usize) -> Result<(), Fault> {
        self.add(name, Named::Body(index))
    }

    /// Names a generator whose nodes begin at body `first`.
    pub(crate) fn add_nodes(&mut self, name: &str, first: usize, layout: Layout) -> Result<(), Fault> {
        self.add(name, Named::Nodes { first, layout })
    }

    fn add(&mut self, name: &str, named: Named) -> Result<(), Fault> {
        if name.is_empty() || name.contains('.') {
            let expected = "a name without dots, which separate a generator from its nodes";
            let problem = Problem::new(format!("the name {:?}", shown(name)), expected, "Choose another name.");
            return Err(Fault::new(Some("name"), problem));
        }
        if self.named.insert(name.to_owned(), named).is_some() {
            let problem = Problem::new(
                format!("a second {:?}", shown(name)),
                "a name that is used once",
                "Rename one of the two.",
            );
            return Err(Fault::new(Some("name"), problem));
        }
        Ok(())
    }

    /// Dense index of the body behind a reference in field `field`.
    pub(crate) fn find(&self, field: &'static str, reference: &str) -> Result<usize, Fault> {
        let (name, node) = reference.split_once('.').unwrap_or((reference, ""));
        match self.named.get(name) {
            Some(Named::Body(index)) if node.is_empty() => Ok(*index),
            Some(Named::Nodes { first, layout }) => match layout.index_of(node) {
                Some(index) => Ok(first + index),
                None => Err(missing(field, reference, &format!("Its nodes are {}.", layout.describe(name)))),
            },
            Some(Named::Body(_)) => {
                Err(missing(field, reference, &format!("{:?} is a body without nodes.", shown(name))))
            }
            None => Err(missing(field, reference, &self.advice(name))),
        }
    }

    /// The bodies that have a name; a generator's nodes are called after it.
    pub(crate) fn of_bodies(&self, ids: &[Id]) -> BTreeMap<Id, String> {
        let mut all = BTreeMap::new();
        for (name, named) in &self.named {
            match *named {
                Named::Body(index) => all.extend([(ids[index], name.clone())]),
                Named::Nodes { first, layout } => {
                    all.extend(
                        (0..layout.count()).map(|node| (ids[first + node], format!("{name}_{}", layout.own(node)))),
                    );
                }
            }
        }
        all
    }

    fn advice(&self, name: &str) -> String {
        match (nearest(name, self.named.keys().map(String::as_str)), self.named.keys().next()) {
            (Some(known), _) => format!("Did you mean {:?}?", shown(known)),
            (None, Some(known)) => format!("Name one of the scene's bodies, for example {:?}.", shown(known)),
            (None, None) => "Give the body a name: `name: \"…\"`.".to_owned(),
        }
    }
}

fn missing(field: &'static str, reference: &str, advice: &str) -> Fault {
    Fault::new(
        Some(field),
        Problem::new(format!("the unknown body {:?}", shown(reference)), "a body of this scene", advice),
    )
}
