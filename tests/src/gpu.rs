//! Devices for tests, opened once a process and used by one test at a time.

use crate::assets::skipped;
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use vsgl_wgpu::{WgpuBackend, WgpuOptions, adapters, is_software};

/// An adapter that tests know how exact to be with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tier {
    /// Mesa's software driver: same bits in strict mode.
    Lavapipe,
    /// Google's software driver: same bits in strict mode, but it takes denormal numbers for zero.
    SwiftShader,
    /// A real GPU: tolerances.
    Hardware,
}

impl Tier {
    /// All tiers.
    pub const ALL: [Self; 3] = [Self::Lavapipe, Self::SwiftShader, Self::Hardware];

    fn is(self, info: &vsgl_wgpu::wgpu::AdapterInfo) -> bool {
        match self {
            Self::Lavapipe => info.name.contains("llvmpipe"),
            Self::SwiftShader => info.name.contains("SwiftShader"),
            Self::Hardware => !is_software(info),
        }
    }
}

/// Names of the adapters of this machine, a tier each.
fn present() -> &'static [(Tier, String)] {
    static PRESENT: OnceLock<Vec<(Tier, String)>> = OnceLock::new();
    PRESENT.get_or_init(|| {
        let all = adapters();
        let one = |tier: Tier| {
            let found = all.iter().find(|info| tier.is(info));
            found.map(|info| (tier, info.name.clone()))
        };
        Tier::ALL.into_iter().filter_map(one).collect()
    })
}

/// Whether this machine has any adapter; if not, the tests that do without are counted.
///
/// # Panics
/// As [`device`].
pub fn some(tests: &str) -> bool {
    if !present().is_empty() {
        return true;
    }
    let off = std::env::var_os("VSGL_GPU").is_some_and(|v| v == "off");
    assert!(
        off && std::env::var_os("CI").is_none(),
        "no graphics adapter: run `scripts/test`, which installs a software driver, or install one (Debian, Ubuntu: \
         apt-get install mesa-vulkan-drivers libvulkan1); VSGL_GPU=off skips these tests"
    );
    skipped(tests, "VSGL_GPU is off");
    false
}

type Slot = OnceLock<Mutex<WgpuBackend>>;

/// The device of a tier, locked for one test; none if this machine has no such adapter, which is counted.
///
/// # Panics
/// If the machine has no adapter at all: tests of the GPU backend that all skip themselves prove nothing. The variable
/// `VSGL_GPU=off` lets them, except where `CI` is set.
pub fn device(tier: Tier, strict: bool, tests: &str) -> Option<MutexGuard<'static, WgpuBackend>> {
    static SLOTS: [[Slot; 2]; 3] = [const { [const { OnceLock::new() }; 2] }; 3];
    if !some(tests) {
        return None;
    }
    let Some((_, name)) = present().iter().find(|(t, _)| *t == tier) else {
        skipped(tests, &format!("no adapter of the kind {tier:?}"));
        return None;
    };
    let slot = &SLOTS[tier as usize][usize::from(strict)];
    let open = || {
        let options = WgpuOptions {
            strict,
            adapter: Some(name.clone()),
            ..WgpuOptions::default()
        };
        WgpuBackend::headless(&options).expect("the adapter was listed")
    };
    let backend = slot.get_or_init(|| Mutex::new(open()));
    // A test that failed leaves nothing behind on the device.
    let backend = backend.lock().unwrap_or_else(PoisonError::into_inner);
    Some(backend)
}

/// The best software device, or whatever there is: for tests that need some device.
///
/// # Panics
/// As [`device`].
pub fn any(strict: bool, tests: &str) -> Option<MutexGuard<'static, WgpuBackend>> {
    let tier = present().first().map_or(Tier::Lavapipe, |(tier, _)| *tier);
    device(tier, strict, tests)
}

/// A device whose rasteriser is as fine as tests of what is drawn take for granted: lavapipe, else a real GPU. SwiftShader
/// snaps corners to a sixteenth of a pixel, so that ids along edges differ too much from those of rays.
///
/// # Panics
/// As [`device`].
pub fn drawing(strict: bool, tests: &str) -> Option<MutexGuard<'static, WgpuBackend>> {
    let fine = [Tier::Lavapipe, Tier::Hardware];
    fine.into_iter()
        .find_map(|tier| device(tier, strict, tests))
}
