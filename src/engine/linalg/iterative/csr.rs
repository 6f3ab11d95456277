//! A sparse matrix stored by rows ("compressed sparse row").

/// Row i has the entries `values[start[i]..start[i + 1]]` in the columns of the same places, ascending. Square.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Csr {
    start: Vec<usize>,
    columns: Vec<u32>,
    values: Vec<f64>,
    diagonal: Vec<f64>,
}

impl Csr {
    /// An n × n matrix of entries (row, column, value) in any order; values of one place add up.
    ///
    /// # Panics
    /// If a row or column is not below n.
    pub fn from_entries(n: usize, entries: &[(u32, u32, f64)]) -> Self {
        let mut sorted = entries.to_vec();
        // Stable: what adds up does so in the order given.
        sorted.sort_by_key(|&(row, column, _)| (row, column));
        let (mut start, mut columns, mut values) = (vec![0; n + 1], Vec::new(), Vec::<f64>::new());
        let (mut diagonal, mut last) = (vec![0.0; n], None);
        for &(row, column, value) in &sorted {
            assert!((row as usize) < n && (column as usize) < n, "({row}, {column}) in an {n} × {n} matrix");
            if last == Some((row, column)) {
                *values.last_mut().expect("there was an entry before") += value;
            } else {
                columns.push(column);
                values.push(value);
            }
            last = Some((row, column));
            start[row as usize + 1] = values.len();
            if row == column {
                diagonal[row as usize] += value;
            }
        }
        // Empty rows end where the one before does.
        for row in 0..n {
            start[row + 1] = start[row + 1].max(start[row]);
        }
        Self { start, columns, values, diagonal }
    }

    /// Takes new values for the entries that there are, row by row with ascending columns.
    pub fn set_values(&mut self, values: impl Iterator<Item = f64>) {
        self.values.iter_mut().zip(values).for_each(|(to, value)| *to = value);
        for row in 0..self.diagonal.len() {
            let entries = self.start[row]..self.start[row + 1];
            let own = self.columns[entries.clone()].binary_search(&(row as u32));
            self.diagonal[row] = own.map_or(0.0, |place| self.values[entries.start + place]);
        }
    }

    /// The number of rows, and of columns.
    pub fn size(&self) -> usize {
        self.diagonal.len()
    }

    /// The diagonal, 0 where there is no entry.
    pub fn diagonal(&self) -> &[f64] {
        &self.diagonal
    }

    /// Columns and values of a row.
    pub fn row(&self, row: usize) -> (&[u32], &[f64]) {
        let range = self.start[row]..self.start[row + 1];
        (&self.columns[range.clone()], &self.values[range])
    }

    /// Row i of A times x.
    pub(super) fn row_times(&self, row: usize, x: &[f64]) -> f64 {
        let (columns, values) = self.row(row);
        columns.iter().zip(values).map(|(&column, value)| value * x[column as usize]).sum()
    }

    /// A x.
    ///
    /// # Panics
    /// If a slice is too short.
    pub fn times(&self, x: &[f64], product: &mut [f64]) {
        (0..self.size()).for_each(|row| product[row] = self.row_times(row, x));
    }
}
