//! Sixteen at a time, or one by one: the same bits.

use crate::texts::{
    Single, block_vpl, block_vsgl, cluster, plan, point, receivers, single_vpl, single_vsgl,
};
use vsgl_core::plan::ShadePlan;
use vsgl_core::settings::{DiffuseForm, Emission, GlossyForm};
use vsgl_cpu::block::{Receivers, Sums};
use vsgl_tests::random::Random;

const ROUNDS: usize = 1500;

/// The sum's lane has the bits of the single sum; NaN and infinity are wrong in any case.
fn same(name: &str, sums: &Sums, lane: usize, single: &Single) {
    let parts = [
        ("diffuse", &sums.diffuse, single.diffuse),
        ("near", &sums.near, single.near),
        ("grazing", &sums.grazing, single.grazing),
    ];
    for (part, lanes, one) in parts {
        for channel in 0..3 {
            let (a, b) = (lanes[channel][lane], one[channel]);
            assert!(
                a.to_bits() == b.to_bits(),
                "{name} {part}: {a:e} in lanes, {b:e} alone"
            );
            assert!(a.is_finite() && a >= 0.0, "{name} {part}: {a:e}");
        }
    }
}

/// The plan with one roughness everywhere, and with two.
fn roughnesses(plan: ShadePlan) -> [ShadePlan; 2] {
    let two = ShadePlan {
        anisotropic_receivers: plan.glossy.two_roughnesses(),
        anisotropic_senders: true,
        ..plan.clone()
    };
    [plan, two]
}

fn clusters_by(plan: &ShadePlan) {
    let mut random = Random(7);
    for round in 0..ROUNDS {
        let single = receivers(&mut random);
        let (d, s) = cluster(&mut random);
        let sums = block_vsgl(&d, &s, &Receivers::new(&single), plan);
        for (lane, receiver) in single.iter().enumerate() {
            let one = single_vsgl(&d, &s, receiver, plan);
            same(&format!("{plan:?} {round} {lane}"), &sums, lane, &one);
        }
    }
}

#[test]
fn clusters() {
    for &emission in Emission::ALL {
        for &diffuse in DiffuseForm::ALL {
            for &glossy in GlossyForm::ALL {
                // The two parts do not know of each other.
                if diffuse != DiffuseForm::V13 && glossy != GlossyForm::NdfFilter {
                    continue;
                }
                for plan in roughnesses(plan(emission, diffuse, glossy)) {
                    clusters_by(&plan);
                }
            }
        }
    }
}

#[test]
fn points() {
    for plan in roughnesses(plan(
        Emission::Cosine,
        DiffuseForm::V13,
        GlossyForm::NdfFilter,
    )) {
        let mut random = Random(8);
        for round in 0..4 * ROUNDS {
            let single = receivers(&mut random);
            let light = point(&mut random);
            let sums = block_vpl(&light, &Receivers::new(&single), &plan);
            for (lane, receiver) in single.iter().enumerate() {
                let one = single_vpl(&light, receiver, &plan);
                same(&format!("{round} {lane}"), &sums, lane, &one);
            }
        }
    }
}
