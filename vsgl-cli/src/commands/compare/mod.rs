//! `vsgl compare`: how far a picture is from a reference.

mod map;
mod report;
mod side;

use crate::args::{CompareArgs, Limit};
use crate::exit::{Failure, Result};
use crate::output::{self, Format, Metadata, Pending};
use crate::{interrupt, text};
use side::Side;
use std::path::Path;
use vsgl_core::metrics::{Errors, Metric, compare};

/// Side of the blocks unless told otherwise.
const SIDE: u32 = 8;

/// Compares, reports, and judges.
///
/// # Errors
/// [`Failure::OverLimit`] if a limit is exceeded, and what reading and writing return.
pub(super) fn run(args: &CompareArgs) -> Result<()> {
    interrupt::listen()?;
    let map = args
        .output
        .as_deref()
        .map(|path| open_map(path, args))
        .transpose()?;
    let test = Side::read(&args.test, &args.layer)?;
    let reference = Side::read(&args.reference, &args.layer)?;
    if test.stands_in && reference.stands_in {
        let problem = format!(
            "no layer `{}`, and {} has none either",
            args.layer,
            args.reference.display()
        );
        return Err(Failure::input(
            &args.test,
            problem,
            "leave --layer away to compare R,G,B",
        ));
    }
    interrupt::check()?;
    let scales = scales(&test, &reference, args)?;
    let verdicts = verdicts(&scales, &args.fail_above, args.side.is_some());
    if let Some(map) = map {
        let drawn = map::draw(&test.plane, &reference.plane, scales[0].eps);
        let metadata = Metadata {
            software: output::software(),
            command: report::command(args),
            ..Metadata::default()
        };
        let (width, height) = (drawn.width as u32, drawn.height as u32);
        map.write(|file| output::png::write(file, width, height, &drawn.pixels, &metadata))?;
    }
    let metrics = if args.metric.is_empty() {
        Metric::ALL
    } else {
        &args.metric
    };
    if args.json {
        text::print_json(&report::document(
            args,
            [&test, &reference],
            &scales,
            metrics,
            &verdicts,
        ))?;
    } else {
        text::print(&report::table(args, [&test, &reference], &scales, metrics))?;
    }
    judge(&verdicts)
}

fn open_map(path: &Path, args: &CompareArgs) -> Result<Pending> {
    if Format::of(path)? != Format::Png {
        return Err(Failure::Usage(format!(
            "{}: the map is a PNG; give a name that ends in .png",
            path.display()
        )));
    }
    if [&args.test, &args.reference]
        .iter()
        .any(|p| output::same_place(p, path))
    {
        return Err(Failure::Usage(format!(
            "{}: the map would replace a picture that is compared; give another name",
            path.display()
        )));
    }
    Pending::create(path)
}

/// Errors per pixel, then of blocks.
fn scales(test: &Side<'_>, reference: &Side<'_>, args: &CompareArgs) -> Result<Vec<Errors>> {
    let (a, b) = (&test.plane, &reference.plane);
    if (a.width(), a.height()) != (b.width(), b.height()) {
        return Err(Failure::Usage(format!(
            "{} is {}x{}, {} is {}x{}; render both with one --size and --stride",
            test.path.display(),
            a.width(),
            a.height(),
            reference.path.display(),
            b.width(),
            b.height()
        )));
    }
    let nothing = |what: &str| {
        let problem = format!("nothing to compare: {what} has finite pixels and reference light");
        Failure::input(reference.path, problem, "check that it shows a lit scene")
    };
    let mut scales = vec![compare(a, b, 1)?.ok_or_else(|| nothing("no pixel"))?];
    let side = args.side.unwrap_or(SIDE);
    if side > 1 {
        match (compare(a, b, side)?, args.side) {
            (Some(errors), _) => scales.push(errors),
            (None, None) => {}
            (None, Some(_)) => return Err(nothing(&format!("no whole {side}x{side} block"))),
        }
    }
    Ok(scales)
}

/// A limit and what was found.
struct Verdict {
    limit: Limit,
    value: f64,
    side: u32,
    over: bool,
}

/// Limits apply after `--box` where that is given, else to pixels.
fn verdicts(scales: &[Errors], limits: &[Limit], blocks: bool) -> Vec<Verdict> {
    let errors = if blocks {
        scales.last()
    } else {
        scales.first()
    };
    let broken = scales.first().is_some_and(|s| s.not_finite > 0);
    let judge = |&limit: &Limit| {
        let errors = errors?;
        let value = errors.get(limit.metric);
        Some(Verdict {
            limit,
            value,
            side: errors.side,
            over: broken || value.abs() > limit.value,
        })
    };
    limits.iter().filter_map(judge).collect()
}

fn judge(verdicts: &[Verdict]) -> Result<()> {
    let over: Vec<_> = verdicts
        .iter()
        .filter(|v| v.over)
        .map(report::verdict)
        .collect();
    if over.is_empty() {
        return Ok(());
    }
    Err(Failure::OverLimit(over.join("; ")))
}
