//! Tables of exact values: comma-separated, with a line of column names.

use crate::exit::{Failure, Result};
use std::path::Path;

/// A table in memory.
#[derive(Clone, Debug)]
pub(super) struct Table {
    columns: Vec<String>,
    rows: Vec<Vec<f64>>,
}

/// One row; columns are found by name.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row<'a> {
    table: &'a Table,
    index: usize,
}

impl Table {
    /// Reads a file. Words stand for numbers where a column holds names: `ggx` is 0, `beckmann` 1.
    ///
    /// # Errors
    /// [`Failure::Input`] for a file that cannot be read, or a cell that is no number.
    pub(super) fn read(path: &Path) -> Result<Self> {
        let remedy = "give a folder of tables as scripts/make_reference.py writes them";
        let text = std::fs::read_to_string(path).map_err(|e| Failure::input(path, e, remedy))?;
        let mut lines = text.lines().filter(|line| !line.is_empty());
        let columns: Vec<String> = split(lines.next().unwrap_or_default())
            .map(String::from)
            .collect();
        let mut rows = Vec::new();
        for (number, line) in lines.enumerate() {
            let cells: Option<Vec<f64>> = split(line).map(value).collect();
            match cells {
                Some(cells) if cells.len() == columns.len() => rows.push(cells),
                _ => {
                    let problem = format!("line {} does not fit the column names", number + 2);
                    return Err(Failure::input(path, problem, remedy));
                }
            }
        }
        Ok(Self { columns, rows })
    }

    /// The rows in order.
    pub(super) fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        (0..self.rows.len()).map(|index| Row { table: self, index })
    }
}

fn split(line: &str) -> impl Iterator<Item = &str> {
    line.split(',').map(str::trim)
}

fn value(cell: &str) -> Option<f64> {
    match cell {
        "ggx" => Some(0.0),
        "beckmann" => Some(1.0),
        _ => cell.parse().ok(),
    }
}

impl Row<'_> {
    /// The exact number in a column; NaN if there is none of that name.
    pub(super) fn exact(&self, column: &str) -> f64 {
        let index = self.table.columns.iter().position(|c| c == column);
        index.map_or(f64::NAN, |i| self.table.rows[self.index][i])
    }

    /// The number in a column as an argument.
    pub(super) fn argument(&self, column: &str) -> f32 {
        self.exact(column) as f32
    }

    /// Three columns as a vector.
    pub(super) fn vector(&self, x: &str, y: &str, z: &str) -> vsgl_core::glam::Vec3 {
        vsgl_core::glam::Vec3::new(self.argument(x), self.argument(y), self.argument(z))
    }
}
