//! What a sweep has found so far: `sweep.jsonl`, from which an interrupted one goes on, and `sweep.csv`.

use crate::exit::{Failure, Result};
use crate::output::Pending;
use serde_json::Value;
use std::fmt::Write as _;
use std::fs::File;
use std::io::{ErrorKind, Read as _, Write as _};
use std::path::{Path, PathBuf};

/// Longest file that is read, in bytes.
const BYTES_MAX: u64 = 1 << 28;
/// Names of the files.
const LINES: &str = "sweep.jsonl";
const TABLE: &str = "sweep.csv";

/// The points of a sweep, each as it will be in the report.
#[derive(Debug)]
pub(super) struct Records {
    folder: PathBuf,
    /// What decides whether points belong to the same sweep, and more about it.
    header: Value,
    /// What was measured, in the order in which it was.
    pub(super) points: Vec<Value>,
}

impl Records {
    /// The records in a folder, or none yet; they must be of the same sweep, by the header's `sweep`.
    ///
    /// # Errors
    /// [`Failure::Output`] if the folder holds another sweep, or a file that is not ours.
    pub(super) fn open(folder: &Path, header: Value) -> Result<Self> {
        let path = folder.join(LINES);
        let text = match read(&path) {
            Ok(text) => text,
            Err(e) if e.kind() == ErrorKind::NotFound => String::new(),
            Err(e) => return Err(Failure::output(&path, e, "give another folder")),
        };
        let mut lines = text.lines();
        let mut points = Vec::new();
        if let Some(first) = lines.next() {
            let there: Option<Value> = serde_json::from_str(first).ok();
            let same = there.is_some_and(|there| there["sweep"] == header["sweep"]);
            if !same {
                let problem =
                    "belongs to another sweep: of another scene, size, reference or version";
                let remedy = "give another folder, or remove this one";
                return Err(Failure::output(&path, problem, remedy));
            }
            // A line that is no point was cut short.
            let point = |line| serde_json::from_str(line).ok().filter(complete);
            points.extend(lines.filter_map(point));
        }
        let folder = folder.to_owned();
        Ok(Self {
            folder,
            header,
            points,
        })
    }

    /// The point of this name.
    pub(super) fn find(&self, id: &str) -> Option<&Value> {
        self.points.iter().find(|p| p["id"] == id)
    }

    /// Appends a point and keeps it.
    ///
    /// # Errors
    /// [`Failure::Output`] if it cannot be written.
    pub(super) fn push(&mut self, point: Value) -> Result<()> {
        self.points.push(point);
        self.write()
    }

    /// Writes all lines.
    ///
    /// # Errors
    /// [`Failure::Output`] if that fails.
    pub(super) fn write(&self) -> Result<()> {
        let mut text = format!("{}\n", self.header);
        for point in &self.points {
            let _ = writeln!(text, "{point}");
        }
        let file = Pending::create(&self.folder.join(LINES))?;
        file.write(|file| file.write_all(text.as_bytes()))
    }

    /// Writes the points as a table.
    ///
    /// # Errors
    /// [`Failure::Output`] if that fails.
    pub(super) fn write_table(&self) -> Result<()> {
        let text = table(&self.points);
        let file = Pending::create(&self.folder.join(TABLE))?;
        file.write(|file| file.write_all(text.as_bytes()))
    }
}

fn read(path: &Path) -> std::io::Result<String> {
    let mut text = String::new();
    File::open(path)?
        .take(BYTES_MAX)
        .read_to_string(&mut text)?;
    Ok(text)
}

/// Whether a point has what the report is made of.
fn complete(point: &Value) -> bool {
    point["id"].is_string() && point["wall"]["median"].is_number() && point["errors"].is_object()
}

/// One row a point; a column for each number. Settings that no point changes have none.
fn table(points: &[Value]) -> String {
    let mut rows: Vec<Vec<(String, String)>> = Vec::new();
    for point in points {
        let mut row = Vec::new();
        for key in [
            "id",
            "backend",
            "front",
            "settings",
            "virtual_lights",
            "runs",
            "wall",
            "cpu",
        ] {
            flatten(key, &point[key], &mut row);
        }
        for phase in point["phases"].as_array().into_iter().flatten() {
            let name = phase["phase"].as_str().unwrap_or_default();
            flatten(&format!("{name}.wall"), &phase["wall"], &mut row);
            flatten(&format!("{name}.cpu"), &phase["cpu"], &mut row);
        }
        flatten("errors", &point["errors"], &mut row);
        rows.push(row);
    }
    let mut columns: Vec<&str> = Vec::new();
    for (name, _) in rows.iter().flatten() {
        if !columns.contains(&name.as_str()) {
            columns.push(name);
        }
    }
    let mut text = columns.join(",") + "\n";
    for row in &rows {
        let cell = |name: &&str| {
            let found = row.iter().find(|(column, _)| column == name);
            found.map_or("", |(_, value)| value)
        };
        let cells: Vec<_> = columns.iter().map(cell).collect();
        text += &(cells.join(",") + "\n");
    }
    text
}

/// Appends the numbers and words in a value, named by their place in it.
fn flatten(name: &str, value: &Value, row: &mut Vec<(String, String)>) {
    match value {
        Value::Null => {}
        Value::Object(map) => {
            for (key, value) in map {
                flatten(&format!("{name}.{key}"), value, row);
            }
        }
        // Ids, settings and numbers hold neither commas nor quotes.
        Value::String(word) => row.push((name.into(), word.clone())),
        other => row.push((name.into(), other.to_string())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn point(id: &str) -> Value {
        json!({
            "id": id, "backend": "cpu", "settings": {"lights": "64"}, "runs": 3,
            "wall": {"median": 0.5}, "cpu": null,
            "phases": [{"phase": "rsm", "wall": 0.1, "cpu": 0.2}],
            "errors": {"whole": {"1": {"mape": 3.0}}},
        })
    }

    #[test]
    fn what_was_kept_is_found_again_and_a_cut_line_is_not() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let header = json!({"sweep": {"scene": "a"}});
        let mut records = Records::open(folder.path(), header.clone()).expect("a new one");
        records.push(point("a")).expect("writable");
        records.push(point("b")).expect("writable");
        let path = folder.path().join(LINES);
        let text = std::fs::read_to_string(&path).expect("readable");
        std::fs::write(&path, &text[..text.len() - 20]).expect("writable");
        let again = Records::open(folder.path(), header).expect("the same");
        assert_eq!(again.points, [point("a")]);
        assert!(again.find("a").is_some() && again.find("b").is_none());
        let other = Records::open(folder.path(), json!({"sweep": {"scene": "b"}}));
        assert_eq!(other.map(|_| ()).map_err(|f| f.code()), Err(5));
    }

    #[test]
    fn tables_have_a_column_for_each_number() {
        let mut faster = point("b");
        faster["settings"] = json!({"interleave": "4"});
        let text = table(&[point("a"), faster]);
        let lines: Vec<_> = text.lines().collect();
        assert_eq!(
            lines[0],
            "id,backend,settings.lights,runs,wall.median,rsm.wall,rsm.cpu,errors.whole.1.mape,settings.interleave"
        );
        assert_eq!(lines[1], "a,cpu,64,3,0.5,0.1,0.2,3.0,");
        assert_eq!(lines[2], "b,cpu,,3,0.5,0.1,0.2,3.0,4");
    }
}
