//! The graph of a symmetric block matrix: a node a block, an edge a pair of blocks that share an off-diagonal entry.

/// Adjacency lists in one array: the neighbours of `k` are `list[start[k]..start[k + 1]]`, ascending, each once.
#[derive(Clone, Debug, Default)]
pub(super) struct Graph {
    start: Vec<u32>,
    list: Vec<u32>,
}

impl Graph {
    /// `pairs` may repeat and stand in any order and orientation; a pair of a block with itself is no edge.
    pub(super) fn build(&mut self, nodes: usize, pairs: &[(u32, u32)]) {
        let edges = || pairs.iter().filter(|(i, j)| i != j).map(|&(i, j)| (i as usize, j as usize));
        self.start.clear();
        self.start.resize(nodes + 1, 0);
        for (i, j) in edges() {
            self.start[i] += 1;
            self.start[j] += 1;
        }
        // Ends first: filling backwards turns every end into its start.
        let mut sum = 0;
        for end in &mut self.start {
            sum += *end;
            *end = sum;
        }
        self.list.clear();
        self.list.resize(sum as usize, 0);
        for (i, j) in edges() {
            for (from, to) in [(i, j), (j, i)] {
                self.start[from] -= 1;
                self.list[self.start[from] as usize] = to as u32;
            }
        }
        self.sort_and_remove_repeats();
    }

    fn sort_and_remove_repeats(&mut self) {
        let mut kept = 0;
        for node in 0..self.start.len().saturating_sub(1) {
            let (from, to) = (self.start[node] as usize, self.start[node + 1] as usize);
            self.list[from..to].sort_unstable();
            self.start[node] = kept as u32;
            let mut last = None;
            for read in from..to {
                let neighbour = self.list[read];
                if last != Some(neighbour) {
                    self.list[kept] = neighbour;
                    kept += 1;
                    last = Some(neighbour);
                }
            }
        }
        if let Some(end) = self.start.last_mut() {
            *end = kept as u32;
        }
        self.list.truncate(kept);
    }

    pub(super) fn nodes(&self) -> usize {
        self.start.len().saturating_sub(1)
    }

    pub(super) fn neighbours(&self, node: usize) -> &[u32] {
        &self.list[self.start[node] as usize..self.start[node + 1] as usize]
    }

    pub(super) fn degree(&self, node: usize) -> usize {
        self.neighbours(node).len()
    }

    /// The nodes of every connected component, in the order in which a search from its lowest node meets them.
    pub(super) fn components(&self) -> Vec<Vec<u32>> {
        let mut met = vec![false; self.nodes()];
        let mut components = Vec::new();
        for root in 0..self.nodes() {
            if met[root] {
                continue;
            }
            met[root] = true;
            let mut found = vec![root as u32];
            let mut next = 0;
            while next < found.len() {
                for &neighbour in self.neighbours(found[next] as usize) {
                    if !std::mem::replace(&mut met[neighbour as usize], true) {
                        found.push(neighbour);
                    }
                }
                next += 1;
            }
            components.push(found);
        }
        components
    }

    /// If the component is a path, its nodes from the end with the lower index to the other.
    pub(super) fn path(&self, component: &[u32]) -> Option<Vec<u32>> {
        let is_end = |&&node: &&u32| self.degree(node as usize) <= 1;
        if component.iter().any(|&node| self.degree(node as usize) > 2) {
            return None;
        }
        let mut here = *component.iter().filter(is_end).min()?;
        let mut path = vec![here];
        let mut from = here;
        while let Some(&next) = self.neighbours(here as usize).iter().find(|&&next| next != from) {
            (from, here) = (here, next);
            path.push(here);
        }
        Some(path)
    }
}
