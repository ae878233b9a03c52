//! Sound files changed at random, by what they mean: read and drawn in this process.

mod judge;
mod mutate;
mod seeds;

use judge::{Outcome, Watch, judge};
use mutate::Vocabulary;
use seeds::Seed;
use std::collections::BTreeMap;
use std::time::{Duration, Instant};
use vsgl_tests::random::Random;

/// A few hundred, always the same ones.
#[test]
fn changed_files_do_no_harm() {
    let run = Run {
        first: 1,
        most: 400,
        time: Duration::from_secs(60),
    };
    run.through(&seeds::made());
}

/// As many as there is time for. Variables: `VSGL_FUZZ_SECONDS` (60), `VSGL_FUZZ_SEED` of the first one (the clock),
/// `VSGL_FUZZ_COUNT` (no end), `VSGL_FUZZ_KEEP`, a folder for the files at fault.
///
/// With `VSGL_ASSETS` the conformance files are changed too.
#[test]
#[ignore = "as long as one likes: VSGL_FUZZ_SECONDS"]
fn fuzz() {
    let number = |name: &str| {
        std::env::var(name)
            .ok()
            .and_then(|text| text.parse::<u64>().ok())
    };
    let clock = || {
        std::time::SystemTime::UNIX_EPOCH
            .elapsed()
            .map_or(0, |t| t.as_secs() << 20)
    };
    let run = Run {
        first: number("VSGL_FUZZ_SEED").unwrap_or_else(clock),
        most: number("VSGL_FUZZ_COUNT").unwrap_or(u64::MAX),
        time: Duration::from_secs(number("VSGL_FUZZ_SECONDS").unwrap_or(60)),
    };
    let mut seeds = seeds::made();
    seeds.extend(seeds::found());
    run.through(&seeds);
}

/// Which mutants to make: number `first` and those after it.
struct Run {
    first: u64,
    most: u64,
    time: Duration,
}

impl Run {
    fn through(&self, seeds: &[Seed]) {
        let vocabulary = Vocabulary::of(seeds);
        let watch = Watch::new();
        let start = Instant::now();
        let mut counts: BTreeMap<&str, u64> = BTreeMap::new();
        let mut faults: BTreeMap<String, String> = BTreeMap::new();
        let (mut slowest, mut largest) = (0.0f64, 0u64);
        let mut made = 0;
        while made < self.most && start.elapsed() < self.time {
            let number = self.first.wrapping_add(made);
            made += 1;
            let mut random = Random(number.wrapping_mul(0x2545_f491_4f6c_dd1d));
            let seed = &seeds[(random.bits() % seeds.len() as u64) as usize];
            let mutant = mutate::mutant(seed, &vocabulary, &mut random);
            let name = format!("mutant {number} of {}", seed.name);
            let judged = judge(&mutant, &name, &mut random, &watch);
            let kind = match &judged.outcome {
                Outcome::Refused => "refused",
                Outcome::Empty => "empty",
                Outcome::Drawn => "drawn",
                Outcome::Fault(_) => "at fault",
            };
            *counts.entry(kind).or_default() += 1;
            slowest = slowest.max(judged.seconds);
            largest = largest.max(judged.peak);
            if let Outcome::Fault(what) = judged.outcome {
                // One of a kind is enough: the same words, numbers aside.
                let kind: String = what
                    .chars()
                    .filter(|c| !c.is_ascii_digit())
                    .take(100)
                    .collect();
                if let std::collections::btree_map::Entry::Vacant(slot) = faults.entry(kind) {
                    println!("{name}: {what}");
                    mutant.keep(number);
                    slot.insert(format!("{name}: {what}"));
                }
            }
        }
        println!(
            "{made} mutants of {} files from number {}: {counts:?}, {} kinds of fault, at most {slowest:.2} s and {} MB, in {:.0} s",
            seeds.len(),
            self.first,
            faults.len(),
            largest / 1000,
            start.elapsed().as_secs_f64()
        );
        let list: Vec<_> = faults.into_values().collect();
        assert!(list.is_empty(), "{}", list.join("\n"));
        let drawn = counts.get("drawn").copied().unwrap_or(0);
        assert!(
            made < 100 || drawn > made / 20,
            "changes that leave nothing to draw show little: {counts:?}"
        );
    }
}
