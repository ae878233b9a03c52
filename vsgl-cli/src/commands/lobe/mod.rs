//! `vsgl lobe`: the mathematics by itself. Judges it against tables of exact values, and draws it.

mod errors;
mod exact;
mod figures;
mod judge;
mod plot;
mod report;
mod table;

pub use errors::{Errors, Limit, Measure};
pub use judge::judge;
pub use report::markdown;

use crate::args::LobeArgs;
use crate::exit::{Failure, Result};
use crate::text;

/// Judges and draws as asked.
///
/// # Errors
/// [`Failure::OverLimit`] if a function errs by more than its documentation states, and what reading and writing return.
pub(super) fn run(args: &LobeArgs) -> Result<()> {
    if let Some(folder) = &args.output {
        let names = figures::draw(folder)?;
        text::warn(&format!(
            "{} plots in {}, each as .svg and .csv",
            names.len(),
            folder.display()
        ));
    }
    if let Some(folder) = &args.check {
        let judged = judge(folder)?;
        if judged.is_empty() {
            return Err(Failure::input(
                folder,
                "no table of a known name",
                "give a folder of tables",
            ));
        }
        if args.json {
            text::print_json(&report::document(&judged))?;
        } else if args.markdown {
            text::print(&report::markdown(&judged))?;
        } else {
            text::print(&report::table(&judged))?;
        }
        let over: Vec<&str> = judged
            .iter()
            .flat_map(|(_, e)| e)
            .filter(|e| !e.holds())
            .map(|e| e.function)
            .collect();
        if !over.is_empty() {
            return Err(Failure::OverLimit(format!(
                "over the stated error: {}",
                over.join(", ")
            )));
        }
    }
    Ok(())
}
