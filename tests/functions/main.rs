//! Every function of the shaders' mathematics against its twin in core, over a million arguments each.
//!
//! In strict mode on a software driver the bits must agree. On one that takes numbers below the normal ones for zero,
//! arguments keep away from them, and what is left of that in a result must be below 1e-12 of its size or below 1e-20.
//!
//! In the ordinary path a driver may regroup sums and products; a result may then be 16 roundings off, or a share of its
//! size that the table states: 1e-5 unless the function magnifies the rounding of what goes into it.

mod arguments;
mod glossy;
mod listing;
mod lobes;
mod math;
mod sets;
mod shading;
mod shares;
mod table;

use self::arguments::rows;
use self::table::{Arguments, Entry};
use std::sync::MutexGuard;
use std::time::Instant;
use vsgl_core::parity::ulps;
use vsgl_tests::gpu::{Tier, device};
use vsgl_wgpu::{Context, Probe, WgpuBackend, link};

/// Calls of each function: 2^20 in all.
const COUNT: usize = 1 << 20;

/// The whole table.
fn entries() -> Vec<Entry> {
    let mut all = math::entries();
    all.extend(lobes::entries());
    all.extend(glossy::entries());
    all.extend(shading::entries());
    all.extend(sets::entries());
    all.extend(shares::entries());
    all
}

/// What was worst in the comparison of one function on one path.
#[derive(Default)]
struct Worst {
    failures: usize,
    /// Error over what is allowed; call; place among all numbers.
    at: Option<(f64, usize, usize)>,
    /// Largest error over the size of its part.
    relative: f64,
    /// Numbers whose bits are not the same.
    differ: usize,
}

/// The numbers of one call, and where they begin among all.
struct Call<'a> {
    number: usize,
    arguments: Arguments<'a>,
    cpu: &'a [f32],
    gpu: &'a [f32],
}

impl Worst {
    fn add(&mut self, entry: &Entry, path: &Path, call: &Call<'_>) {
        if call.cpu.iter().zip(call.gpu).all(|(c, g)| c == g) {
            return;
        }
        let mut at = 0;
        for (number, part) in entry.parts.iter().enumerate() {
            let scale = (entry.scale)(&call.arguments, number);
            let span = at..at + part.len();
            at += part.len();
            let size = call.cpu[span.clone()]
                .iter()
                .fold(scale, |m, x| m.max(x.abs()));
            for i in span {
                let (c, g) = (call.cpu[i], call.gpu[i]);
                // Zeros of both signs are one.
                if c == g {
                    continue;
                }
                self.differ += 1;
                let apart = (f64::from(c) - f64::from(g)).abs();
                let relative = apart / f64::from(size.max(f32::MIN_POSITIVE));
                self.relative = self.relative.max(relative);
                // Numbers below the normal ones became zero on the way.
                let flushed = path.flushes && (relative <= 1e-12 || c.abs().max(g.abs()) < 1e-20);
                let error = if !c.is_finite() || !g.is_finite() {
                    f64::INFINITY
                } else if flushed {
                    0.0
                } else if path.context().strict() {
                    f64::INFINITY
                } else if ulps(c, g) <= 16 {
                    0.0
                } else {
                    relative / f64::from(entry.relative)
                };
                self.failures += usize::from(error > 1.0);
                if self.at.is_none_or(|(most, ..)| error > most) {
                    let place = call.number * call.cpu.len() + i;
                    self.at = Some((error, call.number, place));
                }
            }
        }
    }
}

/// A way in which shaders are compiled.
struct Path {
    name: &'static str,
    device: MutexGuard<'static, WgpuBackend>,
    /// Numbers below the smallest normal one may be zero.
    flushes: bool,
}

impl Path {
    fn context(&self) -> &Context {
        self.device.context()
    }
}

/// The paths of an adapter: strict and ordinary; of a real GPU the latter only, since it rounds quotients and roots as it
/// likes.
fn paths(tier: Tier, test: &str) -> Vec<Path> {
    let path = |name, strict| {
        let device = device(tier, strict, test)?;
        let info = device.context().info();
        println!(
            "{name}: {} ({}), {:?}",
            info.name, info.driver_info, info.backend
        );
        Some(Path {
            name,
            device,
            flushes: tier != Tier::Lavapipe,
        })
    };
    let strict = (tier != Tier::Hardware).then(|| path("strict", true));
    strict
        .flatten()
        .into_iter()
        .chain(path("ordinary", false))
        .collect()
}

/// Compares one function on all paths; a line for each failure.
fn compare(entry: &Entry, seed: u64, paths: &[Path], failed: &mut Vec<String>) {
    let width = entry.width();
    let results = entry.results();
    let numbers = rows(&entry.kinds, COUNT, seed, paths.iter().any(|p| p.flushes));
    let arguments = |call: usize| Arguments {
        kinds: &entry.kinds,
        row: &numbers[call * width..][..width],
    };
    let mut cpu = Vec::with_capacity(COUNT * results);
    for call in 0..COUNT {
        (entry.rust)(&arguments(call), &mut cpu);
    }
    if let Some(at) = cpu.iter().position(|x| x.is_nan()) {
        let row = arguments(at / results).row;
        failed.push(format!("{}: NaN in Rust at {row:?}", entry.name));
        return;
    }
    let source = format!("{}{}", link(&[entry.file]), entry.shader());
    for path in paths {
        let probe = Probe::new(path.context(), &source);
        let probe = probe.unwrap_or_else(|e| panic!("{}: {e}", entry.name));
        // No binding above the 128 MiB that every device has.
        let calls = if width > 24 { COUNT / 2 } else { COUNT };
        let gpu: Vec<f32> = numbers
            .chunks(calls * width)
            .flat_map(|some| {
                let run = probe.run(path.context(), some, (calls / 64) as u32, calls * results);
                run.unwrap_or_else(|e| panic!("{}: {e}", entry.name))
            })
            .collect();
        let mut worst = Worst::default();
        for number in 0..COUNT {
            let span = number * results..(number + 1) * results;
            let call = Call {
                number,
                arguments: arguments(number),
                cpu: &cpu[span.clone()],
                gpu: &gpu[span],
            };
            worst.add(entry, path, &call);
        }
        if worst.differ > 0 {
            println!(
                "{}, {}: {} numbers differ, by {:.1e} of their size at worst",
                entry.name, path.name, worst.differ, worst.relative
            );
        }
        if let (true, Some((_, call, place))) = (worst.failures > 0, worst.at) {
            failed.push(format!(
                "{}, {}: {} of {COUNT} calls fail; worst at {:?}: result {} is {:e} in Rust, {:e} in WGSL",
                entry.name,
                path.name,
                worst.failures,
                arguments(call).row,
                place % results,
                cpu[place],
                gpu[place]
            ));
        }
    }
}

fn check(tier: Tier, test: &str) {
    let paths = paths(tier, test);
    if paths.is_empty() {
        return;
    }
    // Only functions whose names contain it.
    let only = std::env::var("VSGL_PARITY_FUNCTION").unwrap_or_default();
    let clock = Instant::now();
    let mut failed = Vec::new();
    let all = entries();
    for (number, entry) in all.iter().enumerate() {
        if entry.name.contains(&only) {
            compare(entry, 1 + number as u64, &paths, &mut failed);
        }
    }
    let seconds = clock.elapsed().as_secs_f64();
    println!("{} entries of {COUNT} calls: {seconds:.0} s", all.len());
    assert!(
        failed.is_empty(),
        "{} fail:\n{}",
        failed.len(),
        failed.join("\n")
    );
}

#[test]
fn functions_agree_on_lavapipe() {
    check(Tier::Lavapipe, "functions on lavapipe");
}

#[test]
fn functions_agree_on_swiftshader() {
    check(Tier::SwiftShader, "functions on SwiftShader");
}

#[test]
fn functions_agree_on_hardware() {
    check(Tier::Hardware, "functions on hardware");
}

/// That a fault would be found: one that shows in a handful of calls in a million, and one of a single rounding.
#[test]
fn a_wrong_function_is_found() {
    let paths = paths(Tier::Lavapipe, "faults in functions");
    if paths.is_empty() {
        return;
    }
    let fault = |call: &str| {
        let mut failed = Vec::new();
        let wrong = math::entries().swap_remove(0).by(call);
        compare(&wrong, 1, &paths[..1], &mut failed);
        failed
    };
    assert!(fault("elementary_exp(x0)").is_empty());
    assert_eq!(fault("elementary_exp(x0) * 1.0000001").len(), 1);
    assert_eq!(
        fault("select(elementary_exp(x0), 0.0, x0 == 88.0)").len(),
        1
    );
    assert_eq!(fault("exp(x0)").len(), 1);
}
