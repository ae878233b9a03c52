//! Which light a path asks: lights are drawn at random, by shares in 2⁻²⁴.
//!
//! Random numbers have 24 bits, so shares in whole parts of 2⁻²⁴ are chances without any rounding. A tenth of the draws is
//! shared out evenly: a light that sends little may be near, and none is left out.
//!
//! Idea: Shirley, Wang and Zimmerman 1996, "Monte Carlo Techniques for Direct Lighting Calculations" (chances by power).

use crate::data::{LampRecord, LightRecord};
use crate::math::vec::luminance;
use crate::scene::Light;
use crate::settings::LightSampling;
use glam::Vec3;
use std::f64::consts::PI;

/// Parts that a share is measured in.
pub const PARTS: u32 = 1 << 24;
/// Share of the draws that does not follow the power.
pub const EVENLY: f64 = 0.1;

/// Shares of lights of these powers, each added to those before it, in 2⁻²⁴: the last is 2²⁴.
///
/// A light without power has no share. All others have one as far as there are parts: of more than two million some may have none,
/// which then have to be found in other ways.
///
/// ```
/// use vsgl_core::phase::draw::{PARTS, shares};
/// use vsgl_core::settings::LightSampling;
/// assert_eq!(shares(&[1.0, 0.0, 1.0], LightSampling::Power), [PARTS / 2, PARTS / 2, PARTS]);
/// ```
#[must_use]
pub fn shares(power: &[f64], sampling: LightSampling) -> Vec<u32> {
    let sound = |p: &f64| if p.is_finite() && *p > 0.0 { *p } else { 0.0 };
    let total: f64 = power.iter().map(sound).sum();
    let lit = power.iter().filter(|p| sound(p) > 0.0).count();
    let (mut sum, mut count) = (0.0, 0usize);
    let share = |p: &f64| {
        let p = sound(p);
        sum += p;
        count += usize::from(p > 0.0);
        let even = count as f64 / lit.max(1) as f64;
        let share = match sampling {
            LightSampling::Uniform => even,
            LightSampling::Power => {
                sum / total.max(f64::MIN_POSITIVE) * (1.0 - EVENLY) + even * EVENLY
            }
        };
        if count == lit && lit > 0 {
            PARTS
        } else {
            ((share * f64::from(PARTS)) as u32).min(PARTS)
        }
    };
    power.iter().map(share).collect()
}

/// Luminance of the flux that a light sends into a scene within this box \[W\].
#[must_use]
pub fn power(light: &Light, (low, high): (Vec3, Vec3)) -> f64 {
    let brightness = |rgb: [f32; 3]| f64::from(luminance(Vec3::from_array(rgb)));
    match light {
        Light::Spot(spot) => {
            let (inner, outer) = (f64::from(spot.inner).cos(), f64::from(spot.outer).cos());
            // The falloff is the square of a share of the way between both cosines, whose mean is a third.
            let angle = 2.0 * PI * ((1.0 - inner) + (inner - outer) / 3.0);
            brightness(spot.intensity) * angle
        }
        Light::Point(point) => brightness(point.intensity) * 4.0 * PI,
        Light::Directional(sun) => {
            let radius = 0.5 * f64::from((high - low).length());
            brightness(sun.irradiance) * PI * radius * radius
        }
    }
}

/// Lights ready to be drawn: their records with their shares.
#[must_use]
pub fn lights(lights: &[Light], bounds: (Vec3, Vec3), sampling: LightSampling) -> Vec<LightRecord> {
    let powers: Vec<f64> = lights.iter().map(|light| power(light, bounds)).collect();
    let shares = shares(&powers, sampling);
    let record = |(light, passed): (&Light, u32)| LightRecord {
        passed,
        ..LightRecord::from(light)
    };
    lights.iter().zip(shares).map(record).collect()
}

/// Which of a list is drawn by a number 0 ≤ x < 1, and the chance of it; `passed` gives the share of an entry and all before it.
///
/// The entry is the first whose share is above the number. None of an empty list, or where nothing has a share.
pub fn draw(count: usize, passed: impl Fn(usize) -> u32, number: f32) -> Option<(usize, f32)> {
    let wanted = (number * PARTS as f32) as u32;
    let (mut low, mut high) = (0, count);
    while low < high {
        let middle = low + (high - low) / 2;
        if passed(middle) > wanted {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    (low < count).then(|| (low, chance(&passed, low)))
}

/// Chance of an entry.
pub fn chance(passed: impl Fn(usize) -> u32, index: usize) -> f32 {
    let before = if index > 0 { passed(index - 1) } else { 0 };
    (passed(index) - before) as f32 * (1.0 / PARTS as f32)
}

/// Share of a lamp and all before it.
pub fn lamp_passed(lamp: &LampRecord, sampling: LightSampling) -> u32 {
    match sampling {
        LightSampling::Power => lamp.by_power,
        LightSampling::Uniform => lamp.evenly,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{DirectionalLight, PointLight, SpotLight};

    const SAMPLINGS: &[LightSampling] = LightSampling::ALL;

    #[test]
    fn every_number_draws_a_light_by_its_chance() {
        for &sampling in SAMPLINGS {
            for power in [
                &[1.0][..],
                &[0.0, 3.0, 0.0, 1.0, 1e-12, 0.0],
                &[1e30, 1e-30, f64::NAN, f64::INFINITY, 5.0],
            ] {
                let shares = shares(power, sampling);
                let drawn = |parts: u32| {
                    let number = parts as f32 / PARTS as f32;
                    draw(shares.len(), |i| shares[i], number).expect("a light")
                };
                let mut chances = vec![0.0; power.len()];
                let mut first = 0;
                while first < PARTS {
                    let (index, chance) = drawn(first);
                    assert!(power[index] > 0.0 && chance > 0.0, "{power:?}");
                    let end = first + (chance * PARTS as f32) as u32;
                    assert_eq!(drawn(end - 1), (index, chance), "{power:?}");
                    assert_eq!(chances[index], 0.0, "{power:?}: drawn in two places");
                    chances[index] = chance;
                    first = end;
                }
                assert_eq!(first, PARTS);
                for (power, chance) in power.iter().zip(&chances) {
                    assert_eq!(*chance > 0.0, power.is_finite() && *power > 0.0);
                }
            }
        }
    }

    #[test]
    fn chances_follow_the_power() {
        let by_power = shares(&[3.0, 1.0], LightSampling::Power);
        let chance_of = |shares: &[u32], i: usize| chance(|i| shares[i], i);
        assert!((chance_of(&by_power, 0) - (0.9 * 0.75 + 0.05)).abs() < 1e-6);
        let evenly = shares(&[3.0, 1.0, 0.0, 8.0], LightSampling::Uniform);
        for index in [0, 1, 3] {
            assert!((chance_of(&evenly, index) - 1.0 / 3.0).abs() < 1e-6);
        }
        assert_eq!(chance_of(&evenly, 2), 0.0);
    }

    #[test]
    fn nothing_is_drawn_where_nothing_shines() {
        for power in [&[][..], &[0.0, 0.0]] {
            let shares = shares(power, LightSampling::Power);
            assert_eq!(draw(shares.len(), |i| shares[i], 0.3), None);
        }
    }

    /// As many as a scene may have: none is left out.
    #[test]
    fn a_million_lights_all_have_a_chance() {
        let power: Vec<f64> = (0..1 << 20)
            .map(|i| if i == 77 { 1e9 } else { 1e-3 })
            .collect();
        for &sampling in SAMPLINGS {
            let shares = shares(&power, sampling);
            assert!(shares[0] > 0 && shares.windows(2).all(|w| w[0] < w[1]));
        }
    }

    #[test]
    fn powers_of_lights_that_fill_the_same_space_agree() {
        let bounds = (Vec3::ZERO, Vec3::ONE);
        let (position, range) = (Vec3::ZERO, f32::INFINITY);
        let intensity = [2.0; 3];
        let spot = |inner, outer| {
            let axis = Vec3::Z;
            power(
                &Light::Spot(SpotLight {
                    position,
                    axis,
                    intensity,
                    inner,
                    outer,
                    range,
                }),
                bounds,
            )
        };
        let point = power(
            &Light::Point(PointLight {
                position,
                intensity,
                range,
            }),
            bounds,
        );
        let half = std::f32::consts::FRAC_PI_2;
        assert!((spot(half, half) - 0.5 * point).abs() < 1e-5 * point);
        // The integral of the falloff by the midpoint rule.
        let (inner, outer) = (0.4f32, 1.1f32);
        let steps = 10_000;
        let exact: f64 = (0..steps)
            .map(|i| {
                let cosine = (f64::from(i) + 0.5) / f64::from(steps);
                let share = SpotLight::falloff(cosine as f32, inner.cos(), outer.cos());
                2.0 * 2.0 * PI * f64::from(share) / f64::from(steps)
            })
            .sum();
        assert!((spot(inner, outer) - exact).abs() < 1e-3 * exact);
        let sun = Light::Directional(DirectionalLight {
            axis: Vec3::Z,
            irradiance: [1.0; 3],
        });
        assert!((power(&sun, bounds) - 0.75 * PI).abs() < 1e-6);
    }
}
