//! What a comparison found, for people and for machines.

use super::{Side, Verdict};
use crate::args::CompareArgs;
use crate::commands::SCHEMA_VERSION;
use crate::text::{self, json_number, number};
use serde_json::{Value, json};
use vsgl_core::metrics::{EPS_SHARE, Errors, Metric};

/// The command that compares the same again.
pub(super) fn command(args: &CompareArgs) -> String {
    let mut words = vec!["vsgl".to_owned(), "compare".into()];
    words.push(args.test.to_string_lossy().into_owned());
    words.push(args.reference.to_string_lossy().into_owned());
    if !args.layer.is_empty() {
        words.extend(["--layer".into(), args.layer.clone()]);
    }
    if let Some(side) = args.side {
        words.extend(["--box".into(), side.to_string()]);
    }
    text::shell(&words)
}

/// A line for each number, a column for each scale.
pub(super) fn table(
    args: &CompareArgs,
    [test, reference]: [&Side<'_>; 2],
    scales: &[Errors],
    metrics: &[Metric],
) -> String {
    let mut out = format!("{}\n", command(args));
    out += &format!("A  {}\nB  {}\n\n", test.describe(), reference.describe());
    let line = |name: &str, cell: &dyn Fn(&Errors) -> String, note: &str| {
        let mut line = format!("{name:<15}");
        for scale in scales {
            line += &format!("{:>14}", cell(scale));
        }
        format!("{line}  {note}").trim_end().to_owned() + "\n"
    };
    out += &line("", &|s| scale_name(s.side), "");
    out += &line("compared", &|s| s.compared.to_string(), "");
    let dark = "left out: reference is 0";
    out += &line("dark", &|s| s.left_out.to_string(), dark);
    let broken = "left out: infinite or not a number";
    out += &line("not finite", &|s| s.not_finite.to_string(), broken);
    let share = format!("{} % of the mean of B", 100.0 * EPS_SHARE);
    out += &line("eps", &|s| number(s.eps), &share);
    out += &line("mean of A", &|s| number(s.mean_test), "");
    out += &line("mean of B", &|s| number(s.mean_reference), "");
    for &metric in metrics {
        out += &line(metric.word(), &|s| number(s.get(metric)), metric.unit());
    }
    if let Some(map) = &args.output {
        out += &format!("\nmap  {}\n", map.display());
    }
    out
}

fn scale_name(side: u32) -> String {
    match side {
        1 => "pixels".into(),
        _ => format!("{side}x{side} blocks"),
    }
}

/// Everything as JSON. `psnr` of equal pictures, which is infinite, is null.
pub(super) fn document(
    args: &CompareArgs,
    [test, reference]: [&Side<'_>; 2],
    scales: &[Errors],
    metrics: &[Metric],
    verdicts: &[Verdict],
) -> Value {
    let scale = |s: &Errors| {
        let values = metrics
            .iter()
            .map(|&m| (m.word().to_owned(), json_number(s.get(m))));
        json!({
            "box": s.side,
            "compared": s.compared,
            "dark": s.left_out,
            "not_finite": s.not_finite,
            "eps": json_number(s.eps),
            "mean_test": json_number(s.mean_test),
            "mean_reference": json_number(s.mean_reference),
            "metrics": values.collect::<serde_json::Map<_, _>>(),
        })
    };
    let limit = |v: &Verdict| {
        json!({
            "metric": v.limit.metric.word(),
            "box": v.side,
            "value": json_number(v.value),
            "limit": v.limit.value,
            "over": v.over,
        })
    };
    json!({
        "schema_version": SCHEMA_VERSION,
        "command": command(args),
        "test": test.json(),
        "reference": reference.json(),
        "scales": scales.iter().map(scale).collect::<Vec<_>>(),
        "limits": verdicts.iter().map(limit).collect::<Vec<_>>(),
        "map": args.output.as_ref().map(|p| p.to_string_lossy()),
    })
}

/// One limit that is exceeded.
pub(super) fn verdict(verdict: &Verdict) -> String {
    let (metric, limit) = (verdict.limit.metric, verdict.limit.value);
    let value = verdict.value.abs();
    let word = metric.word();
    if value <= limit {
        return format!("{word}: pixels that are not finite exceed every limit");
    }
    let unit = metric.unit();
    format!(
        "{word} of {} is {} {unit}, over the limit of {limit} {unit}",
        scale_name(verdict.side),
        number(value)
    )
}
