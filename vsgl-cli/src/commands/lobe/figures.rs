//! What is drawn: errors over sharpness, the clamped-cosine forms beside the exact integral, glossy forms beside a cubature.

use super::exact;
use super::plot::{Axis, Plot, Scale};
use crate::exit::Result;
use std::path::Path;
use vsgl_core::glam::Vec3;
use vsgl_core::sg::{cosine, glossy, glossy_blend, hemisphere, warp};

type OfCosine = fn(f32, f32) -> f32;
type Glossy = fn(Vec3, Vec3, f32, Vec3, f32) -> f32;

const COSINES: [(&str, OfCosine); 8] = [
    ("constant", cosine::constant),
    ("SG Iwasaki 2012", cosine::sg_iwasaki_2012),
    ("SG product", cosine::sg_product),
    ("2018", cosine::lobes_2018),
    ("2022", cosine::lobes_2022),
    ("2024", cosine::interpolated_2024),
    ("v13", cosine::interpolated_v13),
    ("v14", cosine::interpolated_v14),
];

const HEMISPHERES: [(&str, OfCosine); 3] = [
    ("2018", hemisphere::integral_2018),
    ("2022", hemisphere::integral_2022),
    ("refitted", hemisphere::integral),
];

const GLOSSY: [(&str, Glossy); 5] = [
    ("SG 2015", warp::glossy_sg_2015),
    ("ASG 2015", warp::glossy_asg_2015),
    ("filtering 2024", glossy::filtered_2024),
    ("masked", glossy::masked),
    ("blended", glossy_blend::blended),
];

const SHARPNESS: Axis = Axis {
    label: "sharpness",
    low: 0.01,
    high: 1e4,
    scale: Scale::Logarithmic,
};
const COSINE: Axis = Axis {
    label: "cosine",
    low: -1.0,
    high: 1.0,
    scale: Scale::Linear,
};

fn steps(low: f64, high: f64, count: usize) -> Vec<f64> {
    (0..=count)
        .map(|i| low + (high - low) * i as f64 / count as f64)
        .collect()
}

/// Draws everything into `folder`; returns the names.
///
/// # Errors
/// [`crate::exit::Failure::Output`] if a file cannot be written.
pub(super) fn draw(folder: &Path) -> Result<Vec<String>> {
    let mut plots = vec![
        errors(
            "clamped_cosine_error",
            "Clamped cosine: largest error over the cosine",
            &COSINES[1..],
            1,
        ),
        errors(
            "hemispherical_error",
            "Hemispherical integral: largest error over the cosine",
            &HEMISPHERES,
            0,
        ),
    ];
    for sharpness in [0.5, 4.0, 30.0] {
        plots.push(values(sharpness));
    }
    for sharpness in [3.0, 100.0] {
        plots.push(over_roughness(sharpness));
        plots.push(over_angle(sharpness));
    }
    for plot in &plots {
        plot.write(folder)?;
    }
    Ok(plots.into_iter().map(|p| p.name).collect())
}

/// Largest error over all cosines, relative to the value at cosine 1, by sharpness.
fn errors(name: &str, title: &str, forms: &[(&'static str, OfCosine)], power: i32) -> Plot {
    let at: Vec<f64> = steps(-2.0, 4.0, 60)
        .into_iter()
        .map(|e| 10f64.powf(e))
        .collect();
    let mut lines: Vec<(&'static str, Vec<f64>)> =
        forms.iter().map(|f| (f.0, Vec::new())).collect();
    for &k in &at {
        let k = f64::from(k as f32);
        // Half of the cosines within the width of the lobe from the horizon, where the forms differ.
        let near = steps(-4.0, 4.0, 24)
            .into_iter()
            .map(|x| (x / (k + 16.0).sqrt()).clamp(-1.0, 1.0));
        let cosines: Vec<f64> = steps(-1.0, 1.0, 24).into_iter().chain(near).collect();
        let exact: Vec<f64> = cosines
            .iter()
            .map(|&z| exact::above_horizon(k, f64::from(z as f32), power))
            .collect();
        let peak = exact::above_horizon(k, 1.0, power);
        for (line, form) in lines.iter_mut().zip(forms) {
            let errors = cosines
                .iter()
                .zip(&exact)
                .map(|(&z, e)| (f64::from(form.1(k as f32, z as f32)) - e).abs() / peak);
            line.1.push(errors.fold(0.0, f64::max));
        }
    }
    Plot {
        name: name.into(),
        title: title.into(),
        x: SHARPNESS,
        y: Axis {
            label: "error / value at cosine 1",
            low: 1e-6,
            high: 1.0,
            scale: Scale::Logarithmic,
        },
        at,
        lines,
    }
}

/// All clamped-cosine forms beside the exact integral for one sharpness.
fn values(sharpness: f64) -> Plot {
    let at = steps(-1.0, 1.0, 200);
    let peak = exact::above_horizon(sharpness, 1.0, 1);
    let mut lines = vec![(
        "exact",
        at.iter()
            .map(|&z| exact::above_horizon(sharpness, z, 1) / peak)
            .collect(),
    )];
    for (name, form) in COSINES {
        let value = |&z: &f64| f64::from(form(sharpness as f32, z as f32)) / peak;
        lines.push((name, at.iter().map(value).collect()));
    }
    Plot {
        name: format!("clamped_cosine_{sharpness}"),
        title: format!("Clamped cosine, sharpness {sharpness}"),
        x: COSINE,
        y: Axis {
            label: "integral / value at cosine 1",
            low: 0.0,
            high: 1.25,
            scale: Scale::Linear,
        },
        at,
        lines,
    }
}

/// Values of the glossy forms over the exact one, for a light at the mirrored direction.
fn ratios(
    at: &[f64],
    sharpness: f64,
    surface: impl Fn(f64) -> (f64, f64),
) -> Vec<(&'static str, Vec<f64>)> {
    let exact: Vec<f64> = at
        .iter()
        .map(|&x| {
            let (alpha, angle) = surface(x);
            exact::glossy(alpha, angle, angle, sharpness)
        })
        .collect();
    let line = |form: Glossy| -> Vec<f64> {
        at.iter()
            .zip(&exact)
            .map(|(&x, exact)| {
                let (alpha, angle) = surface(x);
                let (sin, cos) = (angle.sin() as f32, angle.cos() as f32);
                let (view, light) = (Vec3::new(sin, 0.0, cos), Vec3::new(-sin, 0.0, cos));
                f64::from(form(view, Vec3::Z, alpha as f32, light, sharpness as f32)) / exact
            })
            .collect()
    };
    let mut lines = vec![("exact", vec![1.0; at.len()])];
    lines.extend(GLOSSY.map(|(name, form)| (name, line(form))));
    lines
}

const RATIO: Axis = Axis {
    label: "value / exact",
    low: 0.0,
    high: 2.0,
    scale: Scale::Linear,
};

fn over_roughness(sharpness: f64) -> Plot {
    let at: Vec<f64> = steps(-2.0, 0.0, 60)
        .into_iter()
        .map(|e| 10f64.powf(e))
        .collect();
    Plot {
        name: format!("glossy_roughness_{sharpness}"),
        title: format!("GGX, view and light at 45°, sharpness {sharpness}"),
        x: Axis {
            label: "alpha",
            low: 0.01,
            high: 1.0,
            scale: Scale::Logarithmic,
        },
        y: RATIO,
        lines: ratios(&at, sharpness, |alpha| (alpha, std::f64::consts::FRAC_PI_4)),
        at,
    }
}

fn over_angle(sharpness: f64) -> Plot {
    let at = steps(0.0, 88.0, 44);
    Plot {
        name: format!("glossy_angle_{sharpness}"),
        title: format!("GGX, alpha 0.2, light at the mirrored direction, sharpness {sharpness}"),
        x: Axis {
            label: "view angle in degrees",
            low: 0.0,
            high: 90.0,
            scale: Scale::Linear,
        },
        y: RATIO,
        lines: ratios(&at, sharpness, |angle| (0.2, angle.to_radians())),
        at,
    }
}
