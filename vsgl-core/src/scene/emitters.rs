//! Points on the surfaces that shine, drawn once when a scene is prepared.
//!
//! Surfaces that shine are diffuse emitters of radiance `L`: a piece of area `A` sends the flux `π L A` to each side that
//! shines. Triangles with an emissive texture or an alpha mask are cut into cells, each with one radiance. Materials without lighting show their colour and light nothing. Points lie evenly along
//! the sum of the cells' luminances, so every point stands for the same flux, dark texels get none, and the sum of all points
//! is the flux of all cells. Neighbours in the hierarchy of the scene are neighbours in the list.

use crate::data::{
    DOUBLE_SIDED, EmitterRecord, LampRecord, MaterialRecord, NO_TEXTURE, SceneData, UNLIT,
};
use crate::math::vec::luminance;
use crate::phase::footprint::{Footprint, Place};
use crate::phase::pdf::{GOLDEN_TURN, unit};
use crate::phase::{draw, mask, texture};
use crate::settings::LightSampling;
use glam::{DVec3, Vec3};
use std::f64::consts::PI;

/// Number of points.
pub const POINTS: usize = 1 << 16;
/// Most cells of all textured triangles together, and of one.
const CELLS: usize = 1 << 19;
const CELLS_OF_ONE: usize = 1 << 12;

/// Most flux and area of a point: sums over all points stay numbers.
const MOST: f64 = 1e30;

/// A fraction of a turn of 2³², 0.7549: the inverse of the plastic number, so that sides are independent of places.
///
/// Source: Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences".
const SIDE_TURN: u32 = 3_242_174_889;

/// A piece of a triangle with one radiance.
struct Cell {
    triangle: u32,
    /// Barycentric weights of the second and third corner of the triangle, at the corners of the cell.
    corners: [[f32; 2]; 3],
    radiance: [f32; 3],
    /// Luminance of the flux of all sides that shine, of all cells up to this one \[W\].
    passed: f64,
}

/// The points and the triangles; none where nothing shines.
pub(super) fn of(scene: &SceneData) -> (Vec<EmitterRecord>, Vec<LampRecord>) {
    let cells = cells(scene);
    (points(scene, &cells), lamps(&cells))
}

/// The triangles with the shares that they are drawn by.
fn lamps(cells: &[Cell]) -> Vec<LampRecord> {
    let mut lamps: Vec<(u32, f64)> = Vec::new();
    let mut before = 0.0;
    for cell in cells {
        let flux = cell.passed - before;
        before = cell.passed;
        match lamps.last_mut() {
            Some((triangle, sum)) if *triangle == cell.triangle => *sum += flux,
            _ => lamps.push((cell.triangle, flux)),
        }
    }
    let power: Vec<f64> = lamps.iter().map(|&(_, flux)| flux).collect();
    let by_power = draw::shares(&power, LightSampling::Power);
    let evenly = draw::shares(&power, LightSampling::Uniform);
    let shares = by_power.into_iter().zip(evenly);
    let lamp = |(&(triangle, _), (by_power, evenly)): (&(u32, f64), (u32, u32))| LampRecord {
        triangle,
        by_power,
        evenly,
        padding: 0,
    };
    lamps.iter().zip(shares).map(lamp).collect()
}

fn points(scene: &SceneData, cells: &[Cell]) -> Vec<EmitterRecord> {
    let total = cells.last().map_or(0.0, |cell| cell.passed);
    if total <= 0.0 {
        return Vec::new();
    }
    let step = total / POINTS as f64;
    let mut index = 0;
    let point = |i: usize| {
        let wanted = (i as f64 + 0.5) * step;
        while index + 1 < cells.len() && cells[index].passed <= wanted {
            index += 1;
        }
        let before = index.checked_sub(1).map_or(0.0, |b| cells[b].passed);
        let share = (wanted - before) / (cells[index].passed - before).max(f64::MIN_POSITIVE);
        record(
            scene,
            &cells[index],
            i as u32,
            share.clamp(0.0, 1.0) as f32,
            step,
        )
    };
    (0..POINTS).map(point).collect()
}

/// The cells of all triangles that shine, without those that are dark.
fn cells(scene: &SceneData) -> Vec<Cell> {
    let material = |triangle: u32| -> &MaterialRecord {
        &scene.material[scene.triangle_material[triangle as usize] as usize]
    };
    let count = scene.triangle_material.len() as u32;
    let shines = |t: &u32| material(*t).emission != [0.0; 3] && material(*t).flags & UNLIT == 0;
    let textured =
        |t: &u32| material(*t).emissive_texture != NO_TEXTURE || material(*t).alpha_cutoff >= 0.0;
    let patterned = (0..count).filter(|t| shines(t) && textured(t)).count();
    let cuts = (CELLS / patterned.max(1)).clamp(1, CELLS_OF_ONE).isqrt() as u32;
    let mut cells: Vec<Cell> = Vec::new();
    let mut passed = 0.0;
    for triangle in (0..count).filter(shines) {
        let material = material(triangle);
        let cuts = if textured(&triangle) { cuts } else { 1 };
        let sides = if material.flags & DOUBLE_SIDED == 0 {
            1.0
        } else {
            2.0
        };
        let area = 0.5 * normal(scene, triangle).length() / f64::from(cuts * cuts);
        for corners in subdivision(cuts) {
            let radiance = radiance(scene, material, triangle, &corners);
            let flux = PI * area * sides * f64::from(luminance(Vec3::from_array(radiance)));
            if flux > 0.0 && flux.is_finite() {
                passed += flux;
                cells.push(Cell {
                    triangle,
                    corners,
                    radiance,
                    passed,
                });
            }
        }
    }
    cells
}

/// Twice the area of a triangle along its geometric normal, which points to the side that its corners are counted around
/// anticlockwise.
fn normal(scene: &SceneData, triangle: u32) -> DVec3 {
    let c = scene.corner[triangle as usize].map(f64::from);
    let a = DVec3::new(c[0], c[1], c[2]);
    let edge = DVec3::new(c[3], c[4], c[5]) - a;
    let other = DVec3::new(c[6], c[7], c[8]) - a;
    edge.cross(other)
}

/// A triangle cut into `cuts²` equal ones, in the barycentric weights of its second and third corner.
fn subdivision(cuts: u32) -> impl Iterator<Item = [[f32; 2]; 3]> {
    let at = move |i: u32, j: u32| [i as f32 / cuts as f32, j as f32 / cuts as f32];
    let upright = move |i: u32, j: u32| [at(i, j), at(i + 1, j), at(i, j + 1)];
    let turned = move |i: u32, j: u32| [at(i + 1, j + 1), at(i, j + 1), at(i + 1, j)];
    (0..cuts).flat_map(move |i| {
        let row = 0..cuts - i;
        row.flat_map(move |j| {
            let second = (i + j + 1 < cuts).then(|| turned(i, j));
            std::iter::once(upright(i, j)).chain(second)
        })
    })
}

/// Radiance of a cell: that at its centre, in the mean over its size where the texture has smaller images.
fn radiance(
    scene: &SceneData,
    material: &MaterialRecord,
    triangle: u32,
    corners: &[[f32; 2]; 3],
) -> [f32; 3] {
    let [u, v] = [0, 1].map(|k| (corners[0][k] + corners[1][k] + corners[2][k]) / 3.0);
    if !mask::covers(scene, triangle, u, v) {
        return [0.0; 3];
    }
    if material.emissive_texture == NO_TEXTURE || scene.texture.is_empty() {
        return material.emission;
    }
    let side = (corners[1][0] - corners[0][0])
        .abs()
        .max((corners[2][0] - corners[0][0]).abs());
    let place = Place {
        triangle,
        u,
        v,
        footprint: Footprint {
            x: [side, 0.0],
            y: [0.0, side],
        },
    };
    let color = texture::sample(scene, material.emissive_texture, &place, true);
    std::array::from_fn(|i| material.emission[i] * color[i])
}

/// A point of a cell: `share` of the way through it, and along its other side by a golden lattice.
fn record(scene: &SceneData, cell: &Cell, index: u32, share: f32, flux: f64) -> EmitterRecord {
    let triangle = cell.triangle as usize;
    // Uniform on a triangle from two uniform numbers.
    let root = share.sqrt();
    let along = root * unit(index.wrapping_mul(GOLDEN_TURN));
    let [a, b, c] = cell.corners;
    let weights = |k: usize| a[k] + (b[k] - a[k]) * (root - along) + (c[k] - a[k]) * along;
    let (u, v) = (weights(0), weights(1));
    let corner = &scene.corner[triangle];
    let place =
        |k: usize| corner[k] + (corner[3 + k] - corner[k]) * u + (corner[6 + k] - corner[k]) * v;
    let facing = normal(scene, cell.triangle)
        .normalize_or(DVec3::Z)
        .as_vec3();
    let material = &scene.material[scene.triangle_material[triangle] as usize];
    // Of two sides, half of the points are on the other, whichever a smaller map takes.
    let turned = unit(index.wrapping_mul(SIDE_TURN)) >= 0.5;
    let behind = material.flags & DOUBLE_SIDED != 0 && turned;
    let radiance = Vec3::from_array(cell.radiance);
    let brightness = f64::from(luminance(radiance));
    EmitterRecord {
        position: [place(0), place(1), place(2)],
        area: (flux / (PI * brightness)).min(MOST) as f32,
        normal: if behind { -facing } else { facing }.to_array(),
        triangle: cell.triangle,
        flux: cell
            .radiance
            .map(|l| (f64::from(l) / brightness * flux).min(MOST) as f32),
        padding: 0,
    }
}
