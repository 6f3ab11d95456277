//! In which order to eliminate: without fill where that is possible, else by minimum degree.
//!
//! Eliminating an unknown couples all its remaining neighbours with one another: entries of L where A has none, called fill.
//! Whoever has the fewest neighbours left does least harm, so it goes first. The cliques that arise are not stored entry by
//! entry: an eliminated unknown becomes an *element* that lists its neighbours, and two unknowns are coupled if they share an
//! edge or an element (the quotient graph). The degree is bounded from above instead of counted, unknowns with the same
//! neighbours are merged and go together, and an element inside another is absorbed.
//!
//! Amestoy, Davis and Duff, "An approximate minimum degree ordering algorithm", SIAM J. Matrix Anal. Appl. 17 (1996); Davis,
//! "Direct Methods for Sparse Linear Systems" (2006), section 7.1. Ties go to the lowest index: same order in every run.

use super::chordal::orders_without_fill;
use super::graph::Graph;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A node with more neighbours than this times √n is ordered last without being followed: every elimination next to it would
/// walk its long list. The factor is that of Amestoy, Davis and Duff; a lower one costs fill, a much higher one time.
const DENSE: f64 = 10.0;

/// The nodes in order of elimination. `weights[k]` is the number of rows of block k.
pub(super) fn order(graph: &Graph, weights: &[u8]) -> Vec<u32> {
    let mut order = orders_without_fill(graph);
    let mut rest: Vec<u32> = weights.iter().map(|&rows| u32::from(rows)).collect();
    order.iter().for_each(|&node| rest[node as usize] = 0);
    if order.len() < rest.len() {
        order.extend(minimum_degree(graph, rest));
    }
    order
}

/// Nodes of weight 0 are left out; none of the others has one as neighbour.
fn minimum_degree(graph: &Graph, weights: Vec<u32>) -> Vec<u32> {
    let mut quotient = Quotient::new(graph, weights);
    while let Some(Reverse(key)) = quotient.queue.pop() {
        let (degree, node) = ((key >> 32) as u32, key as u32 as usize);
        if quotient.weight[node] > 0 && quotient.degree[node] == degree {
            quotient.eliminate(node);
        }
    }
    quotient.order.append(&mut quotient.later);
    quotient.order
}

/// The quotient graph. A node is a variable while its weight is positive; after its elimination the same number names its element.
struct Quotient {
    /// Of variable i at `start[i]`: `elements[i]` adjacent elements, then `variables[i]` adjacent variables.
    list: Vec<u32>,
    start: Vec<u32>,
    elements: Vec<u32>,
    variables: Vec<u32>,
    /// Rows of the variable with all that were merged into it; 0 for what is no variable (any more).
    weight: Vec<u32>,
    /// Of a variable, a bound of the rows coupled with it; of an element, the rows that it lists.
    degree: Vec<u32>,
    /// The variables of element e: `members[first[e]..last[e]]`.
    members: Vec<u32>,
    first: Vec<u32>,
    last: Vec<u32>,
    /// An element that another one contains is dead.
    alive: Vec<bool>,
    /// Rows of an element outside the newest one; valid where `counted` is the newest element's stamp.
    outside: Vec<u32>,
    counted: Vec<u32>,
    in_newest: Vec<u32>,
    stamp: u32,
    in_list: Vec<u32>,
    comparison: u32,
    /// Nodes merged into a node, as a linked list with its end.
    next_merged: Vec<u32>,
    last_merged: Vec<u32>,
    /// (degree, node), the least first; out of date where the degree has changed since.
    queue: BinaryHeap<Reverse<u64>>,
    queued: Vec<u32>,
    order: Vec<u32>,
    /// The dense nodes.
    later: Vec<u32>,
}

const NONE: u32 = u32::MAX;

impl Quotient {
    fn new(graph: &Graph, mut weight: Vec<u32>) -> Self {
        let n = graph.nodes();
        let dense = (DENSE * (n as f64).sqrt()).max(16.0) as usize;
        let later: Vec<u32> =
            (0..n as u32).filter(|&k| weight[k as usize] > 0 && graph.degree(k as usize) > dense).collect();
        later.iter().for_each(|&node| weight[node as usize] = 0);
        let mut quotient = Self {
            list: Vec::new(),
            start: Vec::with_capacity(n),
            elements: vec![0; n],
            variables: Vec::with_capacity(n),
            degree: vec![0; n],
            members: Vec::new(),
            first: vec![0; n],
            last: vec![0; n],
            alive: vec![false; n],
            outside: vec![0; n],
            counted: vec![0; n],
            in_newest: vec![0; n],
            stamp: 0,
            in_list: vec![0; n],
            comparison: 0,
            next_merged: vec![NONE; n],
            last_merged: (0..n as u32).collect(),
            queue: BinaryHeap::with_capacity(2 * n),
            queued: vec![NONE; n],
            order: Vec::with_capacity(n),
            weight,
            later,
        };
        for node in 0..n {
            quotient.start.push(quotient.list.len() as u32);
            quotient.list.extend(graph.neighbours(node).iter().filter(|&&j| quotient.weight[j as usize] > 0));
            quotient.variables.push(quotient.list.len() as u32 - quotient.start[node]);
            quotient.degree[node] = graph.neighbours(node).iter().map(|&j| quotient.weight[j as usize]).sum();
            if quotient.weight[node] > 0 {
                quotient.enqueue(node);
            }
        }
        quotient
    }

    fn enqueue(&mut self, node: usize) {
        if std::mem::replace(&mut self.queued[node], self.degree[node]) == self.degree[node] {
            return;
        }
        self.queue.push(Reverse(u64::from(self.degree[node]) << 32 | node as u64));
    }

    fn elements_of(&self, node: usize) -> std::ops::Range<usize> {
        let start = self.start[node] as usize;
        start..start + self.elements[node] as usize
    }

    fn variables_of(&self, node: usize) -> std::ops::Range<usize> {
        let start = self.elements_of(node).end;
        start..start + self.variables[node] as usize
    }

    fn eliminate(&mut self, pivot: usize) {
        self.stamp += 1;
        self.weight[pivot] = 0;
        self.form_element(pivot);
        self.count_outside(pivot);
        for k in self.first[pivot] as usize..self.last[pivot] as usize {
            self.update(self.members[k] as usize, pivot);
        }
        self.merge_twins(pivot);
        self.emit(pivot);
        // Only now is it known who is left.
        let (first, mut kept) = (self.first[pivot] as usize, self.first[pivot] as usize);
        for k in first..self.members.len() {
            let node = self.members[k];
            if self.weight[node as usize] > 0 {
                self.members[kept] = node;
                kept += 1;
                self.enqueue(node as usize);
            }
        }
        self.members.truncate(kept);
        self.last[pivot] = kept as u32;
        self.alive[pivot] = kept > first;
    }

    /// The element of the pivot: all that an edge or an element couples with it. The elements used up are absorbed.
    fn form_element(&mut self, pivot: usize) {
        let first = self.members.len();
        let mut rows = 0;
        for k in self.variables_of(pivot) {
            rows += self.join(self.list[k]);
        }
        for k in self.elements_of(pivot) {
            let element = self.list[k] as usize;
            if std::mem::replace(&mut self.alive[element], false) {
                for m in self.first[element]..self.last[element] {
                    rows += self.join(self.members[m as usize]);
                }
            }
        }
        (self.first[pivot], self.last[pivot]) = (first as u32, self.members.len() as u32);
        self.degree[pivot] = rows;
        self.alive[pivot] = true;
    }

    /// Adds a variable to the newest element, once; its rows if it is new.
    fn join(&mut self, node: u32) -> u32 {
        let k = node as usize;
        if self.weight[k] == 0 || self.in_newest[k] == self.stamp {
            return 0;
        }
        self.in_newest[k] = self.stamp;
        self.members.push(node);
        self.weight[k]
    }

    /// For all elements that overlap the newest one: how many of their rows lie outside of it.
    fn count_outside(&mut self, pivot: usize) {
        for m in self.first[pivot]..self.last[pivot] {
            let node = self.members[m as usize] as usize;
            for k in self.elements_of(node) {
                let element = self.list[k] as usize;
                if self.alive[element] {
                    if self.counted[element] != self.stamp {
                        self.counted[element] = self.stamp;
                        self.outside[element] = self.degree[element];
                    }
                    self.outside[element] -= self.weight[node];
                }
            }
        }
    }

    /// Rewrites the lists of a neighbour of the pivot and bounds its new degree. One that is left with no other neighbour than
    /// the pivot's goes together with the pivot.
    fn update(&mut self, node: usize, pivot: usize) {
        let mut write = self.start[node] as usize;
        let mut beyond = 0;
        for k in self.elements_of(node) {
            let element = self.list[k] as usize;
            if self.alive[element] && self.outside[element] > 0 {
                beyond += self.outside[element];
                self.list[write] = element as u32;
                write += 1;
            } else {
                self.alive[element] = false;
            }
        }
        let variables = self.variables_of(node);
        let element_end = write;
        for k in variables {
            let other = self.list[k] as usize;
            if self.weight[other] > 0 && self.in_newest[other] != self.stamp {
                beyond += self.weight[other];
                self.list[write] = other as u32;
                write += 1;
            }
        }
        if beyond == 0 {
            self.merge(node, pivot);
            return;
        }
        // The pivot, or an element absorbed by it, was in the list: there is room for one more.
        self.variables[node] = (write - element_end) as u32;
        self.list[write] = self.list[element_end];
        self.list[element_end] = pivot as u32;
        self.elements[node] = (element_end + 1 - self.start[node] as usize) as u32;
        let inside = self.degree[pivot] - self.weight[node];
        self.degree[node] = (self.degree[node] + inside).min(beyond + inside);
    }

    /// `node` shall be eliminated right after `into`: a variable, or the pivot, whose element it leaves.
    fn merge(&mut self, node: usize, into: usize) {
        if self.weight[into] > 0 {
            self.weight[into] += self.weight[node];
        } else {
            self.degree[into] -= self.weight[node];
        }
        self.weight[node] = 0;
        self.next_merged[self.last_merged[into] as usize] = node as u32;
        self.last_merged[into] = self.last_merged[node];
    }

    /// Variables of the newest element with the same lists will always have the same neighbours: they become one.
    fn merge_twins(&mut self, pivot: usize) {
        let members = self.first[pivot] as usize..self.last[pivot] as usize;
        let mut keys: Vec<(u32, u32)> = Vec::with_capacity(members.len());
        for &node in &self.members[members] {
            let k = node as usize;
            if self.weight[k] > 0 {
                let list = self.start[k] as usize..self.variables_of(k).end;
                keys.push((self.list[list].iter().fold(0, |sum: u32, &id| sum.wrapping_add(id)), node));
            }
        }
        keys.sort_unstable();
        for (at, &(key, node)) in keys.iter().enumerate() {
            if self.weight[node as usize] == 0 {
                continue;
            }
            for &(_, other) in keys[at + 1..].iter().take_while(|(other_key, _)| *other_key == key) {
                if self.weight[other as usize] > 0 && self.same_lists(node as usize, other as usize) {
                    self.degree[node as usize] -= self.weight[other as usize];
                    self.merge(other as usize, node as usize);
                }
            }
        }
    }

    fn same_lists(&mut self, node: usize, other: usize) -> bool {
        if self.elements[node] != self.elements[other] || self.variables[node] != self.variables[other] {
            return false;
        }
        // No number names an element and a variable at once, so that one set of marks is enough.
        self.comparison += 1;
        let length = (self.elements[node] + self.variables[node]) as usize;
        let (a, b) = (self.start[node] as usize, self.start[other] as usize);
        for k in a..a + length {
            self.in_list[self.list[k] as usize] = self.comparison;
        }
        self.list[b..b + length].iter().all(|&id| self.in_list[id as usize] == self.comparison)
    }

    fn emit(&mut self, node: usize) {
        let mut next = node as u32;
        while next != NONE {
            self.order.push(next);
            next = self.next_merged[next as usize];
        }
    }
}
