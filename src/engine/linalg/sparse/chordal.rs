//! Graphs that can be eliminated without any fill: trees, and cliques that hang together like one.
//!
//! Such a graph is called chordal. Minimum degree alone does not always find the order: a node between two large cliques has
//! the lowest degree of all, and its elimination couples them. Numbering backwards, always the node with most numbered
//! neighbours next, does: if the graph is chordal, this order fills nothing in.
//!
//! Tarjan and Yannakakis, "Simple linear-time algorithms to test chordality of graphs", SIAM J. Comput. 13 (1984).

use super::graph::Graph;

/// For every connected component that is chordal, its nodes in an order without fill; of the others nothing. Linear in nodes
/// and edges.
pub(super) fn orders_without_fill(graph: &Graph) -> Vec<u32> {
    let n = graph.nodes();
    let mut search = Search { graph, place: vec![u32::MAX; n], numbered: vec![0; n], stacks: Vec::new() };
    let (mut order, mut mark) = (Vec::with_capacity(n), vec![u32::MAX; n]);
    for root in 0..n {
        if search.place[root] == u32::MAX {
            let component = search.visit(root);
            if search.is_perfect(&component, &mut mark) {
                order.extend(component.into_iter().rev());
            }
        }
    }
    order
}

struct Search<'a> {
    graph: &'a Graph,
    /// When each node was numbered within its component.
    place: Vec<u32>,
    /// How many neighbours are numbered.
    numbered: Vec<u32>,
    /// Nodes by that count; a node whose count has grown since is skipped.
    stacks: Vec<Vec<u32>>,
}

impl Search<'_> {
    /// Numbers a component, the next always a node with most numbered neighbours.
    fn visit(&mut self, root: usize) -> Vec<u32> {
        let mut visited = Vec::new();
        self.push(root as u32, 0);
        let mut top = 0;
        loop {
            let Some(node) = self.stacks[top].pop() else {
                if top == 0 {
                    return visited;
                }
                top -= 1;
                continue;
            };
            let k = node as usize;
            if self.place[k] != u32::MAX || self.numbered[k] as usize != top {
                continue;
            }
            self.place[k] = visited.len() as u32;
            visited.push(node);
            for &neighbour in self.graph.neighbours(k) {
                if self.place[neighbour as usize] == u32::MAX {
                    self.numbered[neighbour as usize] += 1;
                    self.push(neighbour, self.numbered[neighbour as usize] as usize);
                }
            }
            top = self.stacks.len() - 1;
        }
    }

    fn push(&mut self, node: u32, count: usize) {
        while self.stacks.len() <= count {
            self.stacks.push(Vec::new());
        }
        self.stacks[count].push(node);
    }

    /// Whether the neighbours numbered before a node, but for the last of them, are neighbours of that last one: eliminated
    /// backwards, the node then couples nothing anew.
    fn is_perfect(&self, visited: &[u32], mark: &mut [u32]) -> bool {
        let before = |node: u32| {
            let neighbours = self.graph.neighbours(node as usize).iter().copied();
            neighbours.filter(move |&other| self.place[other as usize] < self.place[node as usize])
        };
        let last = |node: u32| Some((before(node).max_by_key(|&other| self.place[other as usize])?, node));
        // Together all nodes with the same last one, so that its neighbours are marked once.
        let mut nodes: Vec<(u32, u32)> = visited.iter().filter_map(|&node| last(node)).collect();
        nodes.sort_unstable();
        let mut marked = u32::MAX;
        nodes.into_iter().all(|(last, node)| {
            if marked != last {
                marked = last;
                mark[last as usize] = last;
                self.graph.neighbours(last as usize).iter().for_each(|&other| mark[other as usize] = last);
            }
            before(node).all(|other| mark[other as usize] == last)
        })
    }
}
