//! `vsgl merge`: parts of a picture of paths, put together.

use super::SCHEMA_VERSION;
use super::sheet::{Sheet, Written};
use crate::args::MergeArgs;
use crate::exit::{Failure, Result};
use crate::output::{self, Format};
use crate::part::{self, Part};
use crate::{interrupt, text};
use serde_json::json;
use std::path::PathBuf;

/// Merges and writes.
///
/// # Errors
/// [`Failure::Parts`] for parts that do not fit together, and what reading and writing return.
pub(super) fn run(args: &MergeArgs) -> Result<()> {
    for path in &args.files {
        Format::of(path)?;
    }
    let all = merged(&args.parts)?;
    let missing = all.about.samples.missing(all.about.of);
    if !missing.is_empty() && !args.allow_missing {
        return Err(Failure::Parts(format!(
            "{}: samples {missing} of {} are missing; give their parts too, or --allow-missing",
            names(&args.parts),
            all.about.of
        )));
    }
    interrupt::listen()?;
    let files = output::open_all(&args.files)?;
    // Of parts the mean is written anew: that of the first one is in `image`.
    let sums = all.sums()?;
    let image = sums.mean(all.image.clone());
    let sheet = Sheet {
        metadata: output::Metadata {
            command: all.about.command.clone(),
            ..all.metadata.clone()
        },
        display: &args.display,
        paths: Some((&all.about, Some(sums))),
    };
    let mut written = Vec::new();
    for (format, file) in files {
        interrupt::check()?;
        written.push(sheet.write(&image, format, file)?);
    }
    if args.json {
        return text::print_json(&json!({
            "schema_version": SCHEMA_VERSION,
            "command": all.about.command,
            "parts": args.parts,
            "samples": all.about.samples.json(),
            "of": all.about.of,
            "fingerprint": all.about.fingerprint,
            "width": image.width,
            "height": image.height,
            "outputs": written.iter().map(Written::json).collect::<Vec<_>>(),
        }));
    }
    if args.quiet {
        return Ok(());
    }
    let mut out = format!("{}\n\n", all.about.command);
    out += &format!("merged    {}\n", super::count(args.parts.len(), "part"));
    out += &format!(
        "written   {}x{}, samples {} of {}\n",
        image.width, image.height, all.about.samples, all.about.of
    );
    out += &written.iter().map(Written::text).collect::<String>();
    text::print(&out)
}

/// All parts as one. One after the other is read, so that two at most are held.
fn merged(paths: &[PathBuf]) -> Result<Part> {
    let mut parts = paths.iter().map(|path| {
        let part = part::read(path)?;
        part.check_version()?;
        part.sums()?;
        Ok(part)
    });
    let mut all: Part = parts
        .next()
        .unwrap_or_else(|| Err(Failure::Usage("no part given; name some".into())))?;
    for part in parts {
        all.merge(&part?)?;
    }
    Ok(all)
}

fn names(paths: &[PathBuf]) -> String {
    let names: Vec<_> = paths.iter().map(|p| p.display().to_string()).collect();
    names.join(", ")
}
