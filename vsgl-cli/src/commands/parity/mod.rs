//! `vsgl parity`: whether an adapter computes what the CPU does.

mod picture;
mod report;

use crate::args::{ParityArgs, Size};
use crate::device::{self, Host};
use crate::exit::{Failure, Result};
use crate::job::{Defaults, Job};
use crate::progress::Progress;
use crate::{interrupt, text};
use picture::Pictures;
use report::Report;
use vsgl_core::parity::{Origin, Party, Step, Subject, Tolerance, chain};
use vsgl_core::settings::Primary;
use vsgl_cpu::CpuBackend;
use vsgl_wgpu::{WgpuBackend, is_software};

/// Small enough for a software adapter, large enough to meet edges and corners.
const DEFAULTS: Defaults = Defaults {
    size: Size {
        width: 320,
        height: 180,
    },
    lights: Some(256),
};

/// Compares, reports, and judges.
///
/// # Errors
/// [`Failure::OverLimit`] if something is over the tolerance, [`Failure::Device`] without an adapter, and what reading,
/// rendering and writing return.
pub(super) fn run(args: &ParityArgs) -> Result<()> {
    interrupt::listen()?;
    let job = Job::with(&args.scene, &args.view, &args.settings, &DEFAULTS)?;
    if job.settings.primary == Primary::Raster {
        return Err(Failure::Usage(
            "parity holds every backend against the rays of the CPU, and --primary raster differs from them along edges; \
             leave it out"
                .into(),
        ));
    }
    for warning in &job.warnings {
        text::warn(&format!("warning: {warning}"));
    }
    let pictures = args.output.as_deref().map(Pictures::prepare).transpose()?;
    let cpu = CpuBackend::new(args.threads)?;
    let adapter = device::open(device::wanted(), false)?;
    let info = adapter.context().info().clone();

    let progress = Progress::new(args.progress);
    let tiers = tiers(&job, &cpu, adapter, &progress);
    progress.finish();
    let tiers = tiers?;
    let written = match pictures {
        Some(pictures) => pictures.write(&tiers, &job)?,
        None => Vec::new(),
    };
    let report = Report {
        job: &job,
        args,
        reference: cpu.origin(),
        adapter: &info,
        tiers: &tiers,
        written,
    };
    if args.json {
        text::print_json(&report.json())?;
    } else {
        text::print(&report.text())?;
    }
    judge(&tiers)
}

/// All comparisons by one tolerance.
struct Tier {
    tolerance: Tolerance,
    /// Where the tested side came from.
    tested: Origin,
    /// What was found, or why the adapter cannot run in this way.
    steps: std::result::Result<Vec<Step>, String>,
}

impl Tier {
    fn passed(&self) -> bool {
        let passed = |steps: &Vec<Step>| steps.iter().all(|s| s.comparison.passed());
        self.steps.as_ref().map_or(true, passed)
    }
}

/// The tiers that make sense on the adapter.
fn tiers(
    job: &Job,
    cpu: &CpuBackend,
    adapter: WgpuBackend,
    progress: &Progress,
) -> Result<Vec<Tier>> {
    let scene = job.prepared()?;
    let compare = |tested: &WgpuBackend, tolerance: Tolerance| -> Result<Tier> {
        let reference = Party {
            backend: cpu,
            origin: cpu.origin(),
        };
        let tested = Party {
            backend: tested,
            origin: tested.origin(),
        };
        let subject = Subject {
            scene: &scene,
            lights: &job.lights,
            view: &job.view,
            plan: &job.plan,
        };
        let steps = chain(&reference, &tested, &subject, &tolerance, progress)?;
        Ok(Tier {
            tolerance,
            tested: tested.origin,
            steps: Ok(steps),
        })
    };
    if !is_software(adapter.context().info()) {
        return Ok(vec![compare(&adapter, Tolerance::HARDWARE)?]);
    }
    let name = adapter.context().info().name.clone();
    let strict = match device::open(Some(name), true) {
        Ok(strict) => compare(&strict, Tolerance::STRICT)?,
        Err(why) => Tier {
            tolerance: Tolerance::STRICT,
            tested: adapter.origin(),
            steps: Err(why.to_string()),
        },
    };
    Ok(vec![strict, compare(&adapter, Tolerance::SOFTWARE)?])
}

fn judge(tiers: &[Tier]) -> Result<()> {
    let over: Vec<String> = tiers
        .iter()
        .filter(|tier| !tier.passed())
        .map(|tier| {
            let steps = tier.steps.iter().flatten();
            let failed = steps.filter(|s| !s.comparison.passed());
            let names: Vec<_> = failed.map(|s| s.stage.to_string()).collect();
            format!("{}: {}", tier.tolerance.name, names.join(", "))
        })
        .collect();
    if over.is_empty() {
        return Ok(());
    }
    let over = over.join("; ");
    Err(Failure::OverLimit(format!("over the tolerance: {over}")))
}
