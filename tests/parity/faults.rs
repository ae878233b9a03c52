//! Faults put into results on purpose: the comparison must find each, and say where it is.

use std::sync::OnceLock;
use vsgl_core::data::{Columns, GBuffer, Image, Pdf, Radiance, Rsm, Vsgls};
use vsgl_core::parity::{
    Comparison, DIFFERENT, Origin, Party, Place, Side, Subject, Tolerance, agreement, chain,
    compare,
};
use vsgl_core::phase::pdf::level_start;
use vsgl_cpu::CpuBackend;
use vsgl_tests::render::Shot;

const WIDTH: usize = 48;

/// Results of all phases of one picture.
struct Results {
    gbuffer: GBuffer,
    rsm: Rsm,
    pdf: Pdf,
    /// By filtered sampling: with kernels.
    filtered: Vsgls,
    /// By the partition: with labels.
    partition: Vsgls,
    radiance: Radiance,
    image: Image,
}

fn results() -> &'static Results {
    static RESULTS: OnceLock<Results> = OnceLock::new();
    RESULTS.get_or_init(|| {
        let shot = Shot::sample("cornell");
        let partition = shot.frame();
        let filtered = shot.with("clustering=filtered").frame();
        Results {
            gbuffer: GBuffer::clone(&filtered.gbuffer),
            rsm: Rsm::clone(filtered.rsm.as_ref().expect("maps")),
            pdf: Pdf::clone(filtered.pdf.as_ref().expect("a density")),
            filtered: Vsgls::clone(filtered.vsgls.as_ref().expect("clusters")),
            partition: Vsgls::clone(partition.vsgls.as_ref().expect("clusters")),
            radiance: Radiance::clone(&filtered.radiance),
            image: Image::clone(&filtered.image),
        }
    })
}

/// Compares a copy with a fault against the original.
fn found<T: Columns>(sound: &T, tolerance: &Tolerance, fault: impl FnOnce(&mut T)) -> Comparison {
    let mut broken = sound.clone();
    fault(&mut broken);
    let [tested, reference] = [Origin::new("tampered", "with"), Origin::new("cpu", "sound")];
    let tested = Side {
        origin: &tested,
        value: &broken,
    };
    let reference = Side {
        origin: &reference,
        value: sound,
    };
    compare(&tested, &reference, tolerance, None).expect("two origins")
}

/// A fault in one column alone; returns where.
fn place(comparison: &Comparison, column: &str) -> Place {
    assert!(!comparison.passed());
    assert!(comparison.misfits.is_empty(), "{:?}", comparison.failures());
    let failed: Vec<_> = comparison.columns.iter().filter(|c| !c.passed).collect();
    assert!(
        failed.len() == 1 && failed[0].name == column,
        "{:?}",
        comparison.failures()
    );
    failed[0].worst.as_ref().expect("a difference").place
}

const TIERS: [Tolerance; 3] = [Tolerance::STRICT, Tolerance::SOFTWARE, Tolerance::HARDWARE];

/// The brightest pixel, where every fault is large.
fn brightest(pixels: &[[f32; 3]]) -> usize {
    let brightest = (0..pixels.len()).max_by(|&a, &b| pixels[a][0].total_cmp(&pixels[b][0]));
    brightest.expect("pixels")
}

#[test]
fn without_a_fault_nothing_is_found() {
    fn check<T: Columns>(sound: &T) {
        for tolerance in TIERS {
            let comparison = found(sound, &tolerance, |_| {});
            assert!(comparison.passed(), "{:?}", comparison.failures());
            assert!(comparison.columns.iter().any(|c| c.entries > 0));
            let differ = |c: &vsgl_core::parity::ColumnVerdict| c.differing + c.unjudged > 0;
            assert!(!comparison.columns.iter().any(differ));
        }
    }
    let all = results();
    check(&all.gbuffer);
    check(&all.rsm);
    check(&all.pdf);
    check(&all.filtered);
    check(&all.partition);
    check(&all.radiance);
    check(&all.image);
}

#[test]
fn one_pixel_scaled_by_one_ulp_is_a_difference_of_bits_alone() {
    let image = &results().image;
    let pixel = brightest(&image.direct);
    let fault = |image: &mut Image| {
        let value = &mut image.direct[pixel][1];
        *value = value.next_up();
    };
    let strict = found(image, &Tolerance::STRICT, fault);
    let (x, y) = ((pixel % WIDTH) as u32, (pixel / WIDTH) as u32);
    assert_eq!(place(&strict, "direct"), Place::Pixel { x, y });
    let direct = strict.column("direct").expect("a column");
    assert_eq!(
        (direct.differing, direct.differing_components, direct.ulps),
        (1, 1, 1)
    );
    let worst = direct.worst.as_ref().expect("a difference");
    assert_eq!((worst.entry, worst.lane), (pixel, 1));
    assert_eq!(worst.reference, f64::from(image.direct[pixel][1]));
    assert!(worst.tested > worst.reference);
    assert!(found(image, &Tolerance::SOFTWARE, fault).passed());
}

#[test]
fn one_pixel_scaled_by_a_thousandth_is_over_the_tolerance() {
    let radiance = &results().radiance;
    let pixel = brightest(&radiance.indirect_diffuse);
    for tolerance in [Tolerance::STRICT, Tolerance::SOFTWARE] {
        let comparison = found(radiance, &tolerance, |radiance| {
            radiance.indirect_diffuse[pixel][0] *= 1.001;
        });
        let (x, y) = ((pixel % WIDTH) as u32, (pixel / WIDTH) as u32);
        assert_eq!(
            place(&comparison, "indirect_diffuse"),
            Place::Pixel { x, y }
        );
        let column = comparison.column("indirect_diffuse").expect("a column");
        assert!((column.relative / 1e-3 - 1.0).abs() < 1e-2);
        let entries = column.entries as f64;
        assert!((column.mean_relative * 3.0 * entries / column.relative - 1.0).abs() < 1e-9);
        let marked = column.errors.iter().filter(|e| **e > 0.0).count();
        assert!(marked == 1 && column.errors[pixel] as f64 > 0.99e-3);
    }
}

#[test]
fn hardware_may_be_far_off_in_few_pixels_and_no_more() {
    let image = &results().image;
    let lit: Vec<usize> = (0..image.direct.len())
        .filter(|&i| image.direct[i].iter().all(|&c| c > 0.0))
        .collect();
    let components = 3 * image.direct.len();
    let off = |count: usize, factor: f32| {
        found(image, &Tolerance::HARDWARE, |image| {
            for &pixel in lit.iter().take(count) {
                image.direct[pixel][0] *= factor;
            }
        })
        .passed()
    };
    assert!(lit.len() > components / 100);
    assert!(off(components / 1000, 1.005) && !off(components / 1000 + 1, 1.005));
    // 3888 components: not one may be off by more than a hundredth.
    assert!(!off(1, 1.02));
}

#[test]
fn two_pixels_swapped_are_both_found() {
    let image = &results().image;
    let first = brightest(&image.direct);
    let second = (0..image.direct.len())
        .find(|&i| image.direct[i][0] > 0.0 && image.direct[i][0] < 0.5 * image.direct[first][0])
        .expect("a darker one");
    for tolerance in [Tolerance::STRICT, Tolerance::SOFTWARE] {
        let comparison = found(image, &tolerance, |image| image.direct.swap(first, second));
        let Place::Pixel { x, y } = place(&comparison, "direct") else {
            panic!("pixels of a picture");
        };
        // Relative to what should be there, the darker one is further off.
        assert_eq!(y as usize * WIDTH + x as usize, second);
        let column = comparison.column("direct").expect("a column");
        assert_eq!(column.differing, 2);
        assert!(column.errors[first] > 0.0 && column.errors[second] > column.errors[first]);
    }
}

#[test]
fn a_shifted_row_is_found_in_ids_and_values() {
    let gbuffer = &results().gbuffer;
    let row = 20;
    for tolerance in TIERS {
        let comparison = found(gbuffer, &tolerance, |gbuffer| {
            let range = row * WIDTH..(row + 1) * WIDTH;
            gbuffer.triangle[range.clone()].rotate_right(1);
            gbuffer.position[range.clone()].rotate_right(1);
            gbuffer.normal[range].rotate_right(1);
        });
        assert!(!comparison.passed());
        for column in ["triangle", "position"] {
            let column = comparison.column(column).expect("a column");
            assert!(!column.passed, "{column:?}");
            let worst = column.worst.as_ref().expect("a difference");
            assert!(matches!(worst.place, Place::Pixel { y: 20, .. }));
        }
        // Where another triangle is seen, its position is no fault of its own.
        let ids = comparison.column("triangle").expect("a column");
        let position = comparison.column("position").expect("a column");
        assert!(ids.decisions > 0 && ids.decisions == position.unjudged);
        assert!(position.differing <= WIDTH - position.unjudged);
    }
}

#[test]
fn nan_and_infinity_are_found_on_either_side_and_on_both() {
    let image = &results().image;
    let pixel = brightest(&image.direct);
    for tolerance in TIERS {
        for wrong in [f32::NAN, f32::INFINITY] {
            let comparison = found(image, &tolerance, |image| image.depth[7] = wrong);
            assert_eq!(place(&comparison, "depth"), Place::Pixel { x: 7, y: 0 });
            let depth = comparison.column("depth").expect("a column");
            assert_eq!((depth.broken, depth.errors[7]), (1, DIFFERENT));
        }
        let mut both = image.clone();
        both.direct[pixel][2] = f32::NAN;
        let comparison = found(&both, &tolerance, |_| {});
        let place = place(&comparison, "direct");
        assert!(matches!(place, Place::Pixel { x, .. } if x as usize == pixel % WIDTH));
        let other_way = found(&both, &tolerance, |image| image.direct[pixel][2] = 0.0);
        assert!(!other_way.passed());
    }
}

#[test]
fn zero_has_one_value_whatever_its_sign() {
    let radiance = &results().radiance;
    let comparison = found(radiance, &Tolerance::STRICT, |radiance| {
        let zeros = radiance.direct.iter_mut().flatten().filter(|c| **c == 0.0);
        assert!(zeros.map(|c| *c = -0.0).count() > 0);
    });
    assert!(comparison.passed(), "{:?}", comparison.failures());
}

#[test]
fn a_wrong_mip_level_is_found_in_the_density_and_in_a_kernel() {
    let all = results();
    let level = 2;
    let start = level_start(all.pdf.size, all.pdf.maps, level);
    let side = (all.pdf.size >> level) as usize;
    let brightest = (start..start + side * side)
        .max_by(|&a, &b| all.pdf.weight[a].total_cmp(&all.pdf.weight[b]))
        .expect("texels");
    // The sum of a texel below instead of its own.
    let below = level_start(all.pdf.size, all.pdf.maps, level - 1);
    for tolerance in [Tolerance::STRICT, Tolerance::SOFTWARE] {
        let comparison = found(&all.pdf, &tolerance, |pdf| {
            pdf.weight[brightest] = pdf.weight[below + 2 * (brightest - start)];
        });
        let (x, y) = (
            ((brightest - start) % side) as u32,
            ((brightest - start) / side) as u32,
        );
        let expected = Place::Level {
            level,
            map: 0,
            x,
            y,
        };
        assert_eq!(place(&comparison, "weight"), expected);
    }
    for tolerance in TIERS {
        let comparison = found(&all.filtered, &tolerance, |vsgls| {
            vsgls.kernel[5][3] *= 2.0;
            // What follows from it is no second fault.
            vsgls.diffuse[5].variance *= 4.0;
        });
        assert_eq!(place(&comparison, "kernel"), Place::Light(5));
        let kernel = comparison.column("kernel").expect("a column");
        assert_eq!((kernel.decisions, kernel.unjudged), (1, 1));
        assert_eq!(
            comparison
                .column("diffuse")
                .map(|c| (c.unjudged, c.differing)),
            Some((1, 0))
        );
    }
}

#[test]
fn a_texel_in_another_cluster_is_found_and_excuses_both_lights() {
    let vsgls = &results().partition;
    let texel = (0..vsgls.label.len())
        .find(|&i| vsgls.label[i] == 3)
        .expect("a texel of light 3");
    let comparison = found(vsgls, &Tolerance::STRICT, |vsgls| {
        vsgls.label[texel] = 9;
        vsgls.diffuse[3].intensity[0] *= 0.5;
        vsgls.diffuse[9].intensity[0] *= 2.0;
    });
    assert_eq!(place(&comparison, "label"), Place::Number(texel as u32));
    let diffuse = comparison.column("diffuse").expect("a column");
    assert_eq!((diffuse.unjudged, diffuse.differing), (2, 0));
    let comparison = found(vsgls, &Tolerance::STRICT, |vsgls| {
        vsgls.label[texel] = 9;
        vsgls.diffuse[4].intensity[0] *= 0.5;
    });
    assert!(!comparison.column("diffuse").expect("a column").passed);
}

#[test]
fn a_wide_light_is_judged_though_sharp_ones_are_a_billion_times_sharper() {
    let vsgls = &results().partition;
    let sharpness = |i: &usize| vsgls.diffuse[*i].sharpness;
    let lights = 0..vsgls.diffuse.len();
    let widest = lights
        .clone()
        .filter(|i| sharpness(i) > 0.0)
        .min_by(|a, b| sharpness(a).total_cmp(&sharpness(b)))
        .expect("lights");
    let sum: f32 = lights.map(|i| sharpness(&i)).sum();
    assert!(sum > 1e9 * sharpness(&widest));
    let comparison = found(vsgls, &Tolerance::SOFTWARE, |vsgls| {
        vsgls.diffuse[widest].sharpness *= 1.001;
    });
    assert_eq!(place(&comparison, "diffuse"), Place::Light(widest as u32));
}

#[test]
fn a_missing_column_and_another_size_are_findings() {
    let all = results();
    assert!(!all.radiance.indirect_glossy.is_empty());
    for tolerance in TIERS {
        let missing = found(&all.radiance, &tolerance, |radiance| {
            radiance.indirect_glossy.clear();
        });
        assert!(!missing.passed());
        let failures = missing.failures();
        let words = ["radiance", "indirect_glossy", "0 entries", "1296"];
        assert!(
            failures.len() == 1 && words.iter().all(|w| failures[0].contains(w)),
            "{failures:?}"
        );
        // The others are still compared.
        assert!(missing.column("direct").is_some_and(|c| c.passed));

        let size = found(&all.image, &tolerance, |image| {
            (image.width, image.height) = (image.height, image.width);
        });
        assert!(!size.passed() && size.columns.is_empty());
        assert!(size.failures()[0].contains("[27, 48] instead of [48, 27]"));
    }
}

#[test]
fn pixels_that_show_another_triangle_are_not_judged_in_the_picture() {
    let all = results();
    let mut gbuffer = all.gbuffer.clone();
    gbuffer.triangle[100] ^= 1;
    let agree = agreement(&gbuffer, &all.gbuffer, 1);
    assert_eq!(agree.iter().position(|a| !a), Some(100));
    // With 3 by 3 samples, the sample lies in column 1 of row 0 of the 16 by 9 pixels: 100 is row 2, column 4.
    assert_eq!(
        agreement(&gbuffer, &all.gbuffer, 3).iter().position(|a| !a),
        Some(1)
    );
    let mut image = all.image.clone();
    image.direct[100][0] += 1.0;
    let [a, b] = [Origin::new("tampered", "with"), Origin::new("cpu", "sound")];
    let judged = |agree: Option<&[bool]>| {
        let (tested, reference) = (
            Side {
                origin: &a,
                value: &image,
            },
            Side {
                origin: &b,
                value: &all.image,
            },
        );
        compare(&tested, &reference, &Tolerance::STRICT, agree).expect("two origins")
    };
    assert!(judged(Some(&agree)).passed());
    assert_eq!(place(&judged(None), "direct"), Place::Pixel { x: 4, y: 2 });
}

#[test]
fn a_backend_is_not_compared_with_itself() {
    let image = &results().image;
    let copy = image.clone();
    let [a, b] = [Origin::new("cpu", "2 threads"), Origin::new("wgpu", "x")];
    for (tested, reference) in [((&a, image), (&a, &copy)), ((&a, image), (&b, image))] {
        let side = |(origin, value)| Side { origin, value };
        let compared = compare(&side(tested), &side(reference), &Tolerance::HARDWARE, None);
        let message = compared.map(|_| ()).map_err(|e| e.to_string());
        assert!(message.is_err_and(|m| m.contains("both sides") && m.contains("image")));
    }
    let shot = Shot::sample("cornell").size(4, 4);
    let backend = CpuBackend::new(1).expect("threads");
    let party = Party {
        backend: &backend,
        origin: a,
    };
    let subject = Subject {
        scene: &vsgl_core::data::SceneData::new(&shot.scene),
        lights: &shot.lights,
        view: &shot.view,
        plan: &shot.plan(),
    };
    let tried = chain(&party, &party, &subject, &Tolerance::STRICT, &());
    assert!(tried.is_err());
}
