//! `vsgl completions` and `vsgl man`.

use crate::args::{Cli, CompletionsArgs, ManArgs};
use crate::exit::{Failure, Result};
use crate::text;
use clap::CommandFactory;

/// Prints a completion script.
///
/// # Errors
/// [`Failure::Output`] if standard output fails.
pub(super) fn completions(args: &CompletionsArgs) -> Result<()> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "vsgl", &mut script);
    text::print(&String::from_utf8_lossy(&script))
}

/// Prints a manual page.
///
/// # Errors
/// [`Failure::Usage`] for an unknown command, [`Failure::Output`] if standard output fails.
pub(super) fn man(args: &ManArgs) -> Result<()> {
    let mut program = Cli::command();
    program.build();
    let command = match args.page.as_deref() {
        None => program.clone(),
        Some(name) => page(&program, name)?,
    };
    let mut text = Vec::new();
    let rendered = clap_mangen::Man::new(command).render(&mut text);
    rendered.map_err(|e| Failure::Internal(e.to_string()))?;
    text::print(&String::from_utf8_lossy(&text))
}

fn page(program: &clap::Command, name: &str) -> Result<clap::Command> {
    let found = program.get_subcommands().find(|c| c.get_name() == name);
    let Some(command) = found else {
        let names: Vec<_> = program.get_subcommands().map(|c| c.get_name()).collect();
        return Err(Failure::Usage(format!(
            "no command `{name}`; commands are {}",
            names.join(", ")
        )));
    };
    Ok(command.clone())
}
