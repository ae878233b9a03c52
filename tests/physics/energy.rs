//! Flux from the lamp to the texels, and from the texels to the clusters.

use std::f64::consts::TAU;
use vsgl_core::data::{Rsm, Vsgls};
use vsgl_core::glam::Vec3;
use vsgl_core::math::vec::luminance;
use vsgl_core::phase::rsm;
use vsgl_core::scene::{Light, SpotLight};
use vsgl_core::sg::lobe;
use vsgl_tests::render::Shot;

/// Flux through all texels of a spot of 1 W/sr, over the exact integral, minus one.
fn flux_error(inner: f32, outer: f32, size: u32) -> f64 {
    let spot = Light::Spot(SpotLight {
        position: Vec3::new(1.0, 2.0, 3.0),
        axis: Vec3::new(0.48, -0.6, 0.64),
        intensity: [1.0; 3],
        inner: inner.to_radians(),
        outer: outer.to_radians(),
        range: f32::INFINITY,
    });
    let map = rsm::maps(&[spot], size, Default::default())[0];
    let texels = (0..size * size).map(|i| f64::from(rsm::ray(&map, size, i % size, i / size).1.x));
    let [inner, outer] = [inner, outer].map(|a| f64::from(a).to_radians().cos());
    // The falloff is t², t from 0 to 1 in the cosine: its mean over the rim is a third.
    let exact = TAU * ((1.0 - inner) + (inner - outer) / 3.0);
    texels.sum::<f64>() / exact - 1.0
}

const CONES: [(f32, f32); 6] = [
    (5.0, 5.0),
    (30.0, 30.0),
    (60.0, 60.0),
    (0.0, 20.0),
    (20.0, 40.0),
    (50.0, 60.0),
];

#[test]
fn texels_hold_the_flux_that_the_spot_emits() {
    for (inner, outer) in CONES {
        for size in [16, 64, 256, 512] {
            let error = flux_error(inner, outer, size);
            println!("{inner} {outer} {size}: {error:.1e}");
            let n = f64::from(size);
            // A texel on a hard edge is in or out as a whole: about `π size` of `π/4 size²` texels are off by 0.29 of
            // themselves (the deviation of a uniform number), independent of each other; three times their deviation.
            // What is smooth has the midpoint rule's error of a texel's width squared.
            let edge = if inner == outer {
                3.0 * 0.29 * (4.0 / n) / (TAU / 2.0 * n).sqrt()
            } else {
                0.0
            };
            let width = 2.0 * f64::from(outer).to_radians().tan() / n;
            let smooth = width * width + 4.0 / (n * n);
            assert!(
                error.abs() < edge + smooth,
                "{inner} {outer} {size}: {error:.2e}"
            );
        }
    }
}

#[test]
fn a_closed_white_room_reflects_all_that_is_emitted() {
    // Both sums run over the same texels: only the f32 products of flux and albedo differ.
    let mut shot = Shot::sample("cornell").with("rsm=128 occlusion=none lights=1");
    for material in &mut shot.scene.materials {
        *material = vsgl_core::scene::Material::lambert("white", [1.0; 3]);
    }
    let frame = shot.size(8, 8).frame();
    let map = frame.rsm.as_ref().expect("a bounce");
    let emitted: f64 = (0..128 * 128u32)
        .map(|i| f64::from(rsm::ray(&map.map[0], 128, i % 128, i / 128).1.y))
        .sum();
    let reflected: f64 = map.diffuse.iter().map(|d| f64::from(d[1])).sum();
    assert!(
        (reflected / emitted - 1.0).abs() < 1e-6,
        "{reflected} of {emitted}"
    );
}

/// Sums over texels and over clusters of the Lambert power, of `F0` and of `F90`, channel by channel.
fn fluxes(map: &Rsm, lights: &Vsgls) -> Vec<(f64, f64)> {
    let mut pairs = Vec::new();
    for channel in 0..3 {
        let texels =
            |column: &[[f32; 4]]| column.iter().map(|v| f64::from(v[channel])).sum::<f64>();
        let power = |f: fn(&Vsgls, usize) -> [f32; 3], count: usize| {
            (0..count)
                .map(|i| f64::from(f(lights, i)[channel]))
                .sum::<f64>()
        };
        let pi = std::f64::consts::PI;
        let (diffuse, specular) = (lights.diffuse.len(), lights.specular.len());
        pairs.push((
            texels(&map.diffuse),
            pi * power(|v, i| v.diffuse[i].intensity, diffuse),
        ));
        pairs.push((
            texels(&map.specular),
            power(|v, i| v.specular[i].f0, specular),
        ));
        pairs.push((
            texels(&map.grazing),
            power(|v, i| v.specular[i].f90, specular),
        ));
    }
    pairs
}

/// Clusterings that put every texel into one cluster.
const EXACT: [&str; 2] = ["partition", "nearest-world"];

#[test]
fn clusters_without_overlap_keep_all_flux() {
    for name in [
        "cornell",
        "glossy-floor",
        "columns",
        "caustic-ring",
        "roughness-row",
        "many-lights:4",
    ] {
        for (clustering, lights) in EXACT.iter().flat_map(|c| [1, 3, 100, 1024].map(|n| (c, n))) {
            let frame = Shot::sample(name)
                .size(8, 8)
                .with(&format!(
                    "rsm=64 occlusion=none clustering={clustering} lights={lights}"
                ))
                .frame();
            let (map, lights) = (frame.rsm.expect("a bounce"), frame.vsgls.expect("clusters"));
            for (texels, clusters) in fluxes(&map, &lights) {
                // Every texel is added once, as a tree of at most 14 levels: 14 roundings of 6e-8.
                assert!(
                    (clusters - texels).abs() <= 1e-6 * texels,
                    "{name}, {clustering}: {clusters} of {texels}"
                );
            }
        }
    }
}

#[test]
fn whole_maps_keep_all_flux_and_are_a_partition_of_one() {
    for (name, maps) in [
        ("cornell", 1),
        ("glossy-floor", 1),
        ("roughness-row", 1),
        ("many-lights:4", 4),
    ] {
        // Sizes that chunks divide, and do not.
        for rsm in [1, 17, 64, 100] {
            let by = |clustering: &str| {
                let settings = format!("clustering={clustering} lights=1 rsm={rsm}");
                Shot::sample(name).size(4, 4).with(&settings).frame()
            };
            let frame = by("whole");
            let (map, whole) = (frame.rsm.expect("a bounce"), frame.vsgls.expect("clusters"));
            assert!(whole.count <= maps);
            for (texels, clusters) in fluxes(&map, &whole) {
                assert!(
                    (clusters - texels).abs() <= 1e-6 * texels,
                    "{name} {rsm}: {clusters} of {texels}"
                );
            }
            // The same sets summed up in another order.
            let one = by("partition").vsgls.expect("clusters");
            assert_eq!(whole.count, one.count, "{name} {rsm}");
            for (a, b) in whole.diffuse.iter().zip(&one.diffuse) {
                let scale = b.variance.sqrt() + 1e-3;
                let apart = Vec3::from_array(a.position) - Vec3::from_array(b.position);
                assert!(apart.length() < 1e-5 * (1.0 + scale), "{name} {rsm}");
                assert!((a.variance - b.variance).abs() <= 1e-4 * b.variance);
                assert!((a.complement - b.complement).abs() <= 1e-5);
            }
            for &texel in &whole.texel {
                assert!(map.weight(texel as usize) > 0.0, "a target without light");
            }
        }
    }
}

#[test]
fn two_gaussians_carry_the_flux_of_a_map_each_from_its_own_place() {
    let by = |settings: &str| {
        let shot = Shot::sample("cornell").size(4, 4).with("rsm=64 lights=1");
        let frame = shot.with(settings).frame();
        (frame.rsm.expect("a bounce"), frame.vsgls.expect("clusters"))
    };
    let (map, cosine) = by("clustering=whole");
    let (_, published) = by("clustering=whole emission=sg sharpness=toksvig variance=trace");
    let (_, common) = by("clustering=partition emission=sg sharpness=toksvig variance=trace");
    let (d, s) = (&published.diffuse[0], &published.specular[0]);
    for channel in 0..3 {
        let flux: f64 = map.diffuse.iter().map(|v| f64::from(v[channel])).sum();
        let sent = f64::from(d.intensity[channel]) * f64::from(lobe::integral(d.sharpness));
        assert!((sent / flux - 1.0).abs() < 1e-5, "{sent} of {flux}");
    }
    let specular: f64 = map.grazing.iter().map(|v| f64::from(v[3])).sum();
    let sent =
        f64::from(luminance(Vec3::from_array(s.f0))) * f64::from(lobe::integral(s.sharpness_lobe));
    assert!((sent / specular - 1.0).abs() < 1e-5, "{sent} of {specular}");
    // Each where the other emission has it too; the trace is twice the variance along an axis.
    assert_eq!(d.position, cosine.diffuse[0].position);
    assert_eq!(s.position, cosine.specular[0].position);
    assert_ne!(d.position, s.position);
    assert!((d.variance / cosine.diffuse[0].variance - 2.0).abs() < 1e-5);
    // As published in 2016 both are at one place, between the two.
    assert_eq!(common.diffuse[0].position, common.specular[0].position);
    let place = |p: [f32; 3]| Vec3::from_array(p);
    let (a, b) = (place(d.position), place(s.position));
    let c = place(common.diffuse[0].position);
    assert!((a.distance(c) + c.distance(b) - a.distance(b)).abs() < 1e-4 * a.distance(b));
}

#[test]
fn every_lit_texel_is_in_one_cluster() {
    for (clustering, lights) in EXACT.iter().flat_map(|c| [1, 7, 300, 5000].map(|n| (c, n))) {
        let shot = Shot::sample("cornell").size(8, 8).with(&format!(
            "occlusion=none clustering={clustering} lights={lights}"
        ));
        let frame = shot.frame();
        let (map, vsgls) = (frame.rsm.expect("a bounce"), frame.vsgls.expect("clusters"));
        assert!(vsgls.count <= lights);
        let mut members = vec![0; vsgls.count as usize];
        for (texel, &label) in vsgls.label.iter().enumerate() {
            let (diffuse, specular) = map.weights(texel);
            assert_eq!(
                label == u32::MAX,
                diffuse + specular <= 0.0,
                "texel {texel}"
            );
            if label != u32::MAX {
                members[label as usize] += 1;
            }
        }
        assert!(members.iter().all(|&m| m > 0), "an empty cluster");
        for (cluster, &texel) in vsgls.texel.iter().enumerate() {
            assert_eq!(
                vsgls.label[texel as usize] as usize, cluster,
                "a target of another cluster"
            );
        }
    }
}

/// Flux of all clusters over that of all texels, minus one.
fn flux_of_clusters(name: &str, settings: &str) -> f64 {
    let shot = Shot::sample(name).size(8, 8).with("rsm=128 occlusion=none");
    let frame = shot.with(settings).frame();
    let pairs = fluxes(
        &frame.rsm.expect("a bounce"),
        &frame.vsgls.expect("clusters"),
    );
    let sum = pairs.iter().fold((0.0, 0.0), |s, p| (s.0 + p.0, s.1 + p.1));
    let error = sum.1 / sum.0 - 1.0;
    println!("{name}, {settings}: {:+.2} %", 100.0 * error);
    error
}

#[test]
fn kernels_keep_the_flux_in_the_mean() {
    for name in ["cornell", "glossy-floor", "columns", "roughness-row"] {
        for clustering in ["filtered", "filtered-box"] {
            let settings = format!("clustering={clustering} lights=512");
            let error = flux_of_clusters(name, &settings);
            // Kernels are drawn, and each is scaled to its share of the density, which is the luminance of both parts
            // together; single colours and parts come out right in the mean only.
            assert!(error.abs() < 0.05, "{name}, {settings}: {error}");
        }
    }
}

/// A kernel whose size follows from its centre alone is too bright where the centre is darker than what it covers: in the
/// mean all clusters have the flux of the map blurred by its own kernels. It comes right as kernels become texels.
#[test]
fn kernels_of_original_size_keep_the_flux_with_many_lights() {
    for name in ["cornell", "glossy-floor", "columns", "roughness-row"] {
        let error = [64, 512, 4096, 65_536].map(|lights| {
            flux_of_clusters(
                name,
                &format!("clustering=filtered-original lights={lights}"),
            )
        });
        assert!(
            error[3].abs() < 0.01 && error.iter().all(|e| e.abs() < 0.25),
            "{name}: {error:?}"
        );
    }
}

#[test]
fn rounds_suffice_for_as_many_clusters_as_asked_for() {
    for name in ["cornell", "glossy-floor", "caustic-ring", "many-lights:3"] {
        for lights in [1, 2, 16, 256, 4096, 65_536] {
            let shot = Shot::sample(name)
                .size(2, 2)
                .with(&format!("occlusion=none lights={lights}"));
            let frame = shot.frame();
            let vsgls = frame.vsgls.expect("clusters");
            let lit = vsgls.label.iter().filter(|&&l| l != u32::MAX).count();
            let maps = frame.rsm.expect("maps").maps as usize;
            let asked = (lights as usize).max(maps).min(lit);
            assert_eq!(vsgls.count as usize, asked, "{name}, {lights} lights");
        }
    }
}

/// The texels of a cluster are nearer to its centre than to any other; the test finds the centres anew.
#[test]
fn texels_go_to_the_nearest_centre() {
    use vsgl_core::phase::nearest::{centres, drawn};
    for name in ["cornell", "columns", "many-lights:3"] {
        let shot = Shot::sample(name)
            .size(8, 8)
            .with("rsm=32 occlusion=none clustering=nearest-world lights=60");
        let frame = shot.frame();
        let (map, pdf) = (
            frame.rsm.expect("a bounce"),
            frame.pdf.expect("centres are drawn"),
        );
        let lights = frame.vsgls.expect("clusters");
        let mut members = vec![Vec::new(); lights.count as usize];
        for m in 0..map.maps {
            let count = centres(&pdf, m);
            let all: Vec<usize> = (0..count)
                .map(|i| {
                    let (x, y) = drawn(&pdf, m, map.size, i, count);
                    ((m * map.size + y) * map.size + x) as usize
                })
                .collect();
            let place = |t: usize| Vec3::from_slice(&map.position[t]);
            let per_map = (map.size * map.size) as usize;
            for texel in m as usize * per_map..(m as usize + 1) * per_map {
                if map.weight(texel) <= 0.0 {
                    continue;
                }
                let apart = |c: &usize| (place(*c) - place(texel)).length_squared();
                let nearest = all
                    .iter()
                    .min_by(|a, b| apart(a).total_cmp(&apart(b)))
                    .expect("a lit map has a centre");
                members[lights.label[texel] as usize].push(*nearest);
            }
        }
        // Two centres may share a texel; it is the texel that tells clusters apart.
        let mut seen = std::collections::BTreeSet::new();
        for cluster in members {
            assert!(cluster.iter().all(|c| *c == cluster[0]), "{name}");
            assert!(seen.insert(cluster[0]), "{name}: one centre, two clusters");
        }
    }
}

/// However uneven the density is, square kernels together cover a few maps, and a few texels each beside it.
#[test]
fn squares_cover_a_few_maps_together() {
    for name in [
        "cornell",
        "glossy-floor",
        "columns",
        "caustic-ring",
        "roughness-row",
    ] {
        for lights in [16, 256, 4096, 65_536] {
            let settings =
                format!("rsm=128 occlusion=none clustering=filtered-box lights={lights}");
            let frame = Shot::sample(name).size(2, 2).with(&settings).frame();
            let vsgls = frame.vsgls.expect("clusters");
            let cut = |c: f32, side: f32| {
                f64::from((c + 0.5 * side).min(128.0) - (c - 0.5 * side).max(0.0))
            };
            let area = |k: &[f32; 4]| cut(k[1], k[3]) * cut(k[2], k[3]);
            let sum: f64 = vsgls.kernel.iter().map(area).sum();
            let maps = sum / (128.0 * 128.0);
            println!("{name}, {lights} lights: {maps:.2} maps");
            assert!(maps < 4.0, "{name}, {lights} lights: {maps}");
        }
    }
}
