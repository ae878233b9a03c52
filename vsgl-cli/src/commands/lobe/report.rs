//! Errors as text: a table for the terminal, Markdown for the documentation, JSON for programs.

use super::errors::{Errors, RANGES};
use std::fmt::Write;

type Judged = [(&'static str, Vec<Errors>)];

fn short(value: f64) -> String {
    if value == 0.0 {
        "0".into()
    } else if (0.01..100.0).contains(&value) {
        format!("{value:.3}")
    } else {
        format!("{value:.1e}")
    }
}

/// A table for the terminal.
pub(super) fn table(judged: &Judged) -> String {
    let mut text = String::new();
    for (name, all) in judged {
        let _ = writeln!(text, "{name}");
        for e in all {
            let _ = writeln!(
                text,
                "  {:5} {:52} {:8} {:>5} rows  median {:>7}  mean {:>7}  p95 {:>7}  p99 {:>7}  max {:>7}  stated {}{}",
                if e.holds() { "ok" } else { "OVER" },
                e.function,
                e.measure.name(),
                e.count(),
                short(e.percentile(0.5)),
                short(e.mean()),
                short(e.percentile(0.95)),
                short(e.percentile(0.99)),
                short(e.max()),
                e.limit.text(),
                if e.unfit > 0 {
                    format!("  {} values not finite or negative", e.unfit)
                } else {
                    String::new()
                },
            );
            let ranges: Vec<String> = e
                .ranges()
                .iter()
                .zip(RANGES)
                .filter_map(|(max, (label, ..))| max.map(|m| format!("{label}: {}", short(m))))
                .collect();
            if ranges.len() > 1 {
                let _ = writeln!(text, "        max by sharpness  {}", ranges.join("   "));
            }
        }
    }
    text
}

const HEAD: &str = "\
# Accuracy of the mathematics

Measured in `f32` against the exact values in `tests/reference`; made by

    vsgl lobe --check tests/reference --markdown > docs/accuracy.md

and a test fails when it is not current. `scripts/make_reference.py --seed N` makes tables with other arguments, and
`vsgl lobe --check DIR` judges by them: it ends with 1 if a function errs by more than what is stated in the last column.

*ULP* is a unit in the last place of the exact value. *Of peak* is relative to the value at cosine 1 for the same
sharpness, *of log* to one more than the magnitude of the logarithm. Approximations of the GGX integral are stated by their
median, over rows above a thousandth of the largest with the same surface, view and sharpness.
";

/// The tables of `docs/accuracy.md`.
pub fn markdown(judged: &Judged) -> String {
    let mut text = String::from(HEAD);
    for (name, all) in judged {
        let _ = write!(
            text,
            "\n## {name}.csv\n\n| function | error | rows | median | mean | p99 | max |"
        );
        let ranged = all.iter().any(|e| e.ranges().iter().flatten().count() > 1);
        if ranged {
            for (label, ..) in RANGES {
                let _ = write!(text, " max, {label} |");
            }
        }
        text.push_str(" stated |\n|---|---|---|---|---|---|---|");
        text.push_str(if ranged {
            "---|---|---|---|---|\n"
        } else {
            "---|\n"
        });
        for e in all {
            let _ = write!(
                text,
                "| `{}` | {} | {} | {} | {} | {} | {} |",
                e.function,
                e.measure.name(),
                e.count(),
                short(e.percentile(0.5)),
                short(e.mean()),
                short(e.percentile(0.99)),
                short(e.max()),
            );
            if ranged {
                for max in e.ranges() {
                    let _ = write!(text, " {} |", max.map_or("–".into(), short));
                }
            }
            let _ = writeln!(text, " {} |", e.limit.text());
        }
    }
    text
}

/// The errors as JSON.
pub(super) fn document(judged: &Judged) -> serde_json::Value {
    let number = crate::text::json_number;
    let tables: Vec<_> = judged
        .iter()
        .map(|(name, all)| {
            let functions: Vec<_> = all
                .iter()
                .map(|e| {
                    serde_json::json!({
                        "function": e.function,
                        "measure": e.measure.name(),
                        "rows": e.count(),
                        "median": number(e.percentile(0.5)),
                        "mean": number(e.mean()),
                        "p95": number(e.percentile(0.95)),
                        "p99": number(e.percentile(0.99)),
                        "max": number(e.max()),
                        "max_by_sharpness": e.ranges().map(|m| m.map_or(serde_json::Value::Null, number)),
                        "unfit": e.unfit,
                        "stated": e.limit.text(),
                        "holds": e.holds(),
                    })
                })
                .collect();
            serde_json::json!({ "table": name, "functions": functions })
        })
        .collect();
    serde_json::json!({ "schema_version": super::super::SCHEMA_VERSION, "tables": tables })
}
