//! Flicker: what changes in a picture from frame to frame beside what should.
//!
//! The error of a frame is its difference from a reference of the same frame. Light that moves changes both; what flickers
//! is the change of the error. An error that stays where it is does not flicker, and errors of frames that have nothing to
//! do with each other flicker by √2 of their size.

use crate::render::Shot;
use vsgl_core::glam::{Quat, Vec3};
use vsgl_core::metrics::luminance;
use vsgl_core::scene::Light;

/// Luminances of the indirect light of each frame.
#[derive(Clone, Debug)]
pub struct Frames {
    width: usize,
    frames: Vec<Vec<f64>>,
}

/// Means over all frames, each over the mean of the reference.
#[derive(Clone, Copy, Debug)]
pub struct Flicker {
    /// Mean absolute error.
    pub error: f64,
    /// Mean absolute change of the error from one frame to the next.
    pub change: f64,
}

/// The lamps of a shot, moved along `way` and turned about the vertical by so many steps.
#[must_use]
pub fn lamps_moved(shot: &Shot, way: Vec3, turn: f32, steps: f32) -> Shot {
    let mut shot = shot.clone();
    let turn = Quat::from_rotation_y(turn * steps);
    for light in &mut shot.lights {
        if let Light::Spot(spot) = light {
            spot.position += way * steps;
            spot.axis = (turn * spot.axis).normalize();
        }
    }
    shot
}

/// The camera of a shot, moved along `way` and turned about the vertical by so many steps.
#[must_use]
pub fn camera_moved(shot: &Shot, way: Vec3, turn: f32, steps: f32) -> Shot {
    let mut shot = shot.clone();
    let turn = Quat::from_rotation_y(turn * steps);
    let camera = &mut shot.view.camera;
    camera.eye += way * steps;
    for direction in [&mut camera.forward, &mut camera.right, &mut camera.up] {
        *direction = (turn * *direction).normalize();
    }
    shot
}

impl Frames {
    /// Renders all shots with some settings.
    ///
    /// # Panics
    /// If the settings are not sound.
    pub fn render(shots: &[Shot], settings: &str) -> Self {
        let one = |shot: &Shot| {
            let image = shot.clone().with(settings).image();
            image.indirect().iter().map(|&c| luminance(c)).collect()
        };
        Self {
            width: shots[0].view.width as usize,
            frames: shots.iter().map(one).collect(),
        }
    }

    /// Means of squares of 8 by 8 pixels; what is left at the right and at the bottom is cut off.
    #[must_use]
    pub fn boxed(&self) -> Self {
        let columns = self.width / 8;
        let boxed = |frame: &Vec<f64>| {
            let rows = frame.len() / self.width / 8;
            let mut out = vec![0.0; columns * rows];
            for y in 0..rows * 8 {
                for x in 0..columns * 8 {
                    out[y / 8 * columns + x / 8] += frame[y * self.width + x] / 64.0;
                }
            }
            out
        };
        Self {
            width: columns,
            frames: self.frames.iter().map(boxed).collect(),
        }
    }

    /// Error and flicker beside the frames of a reference.
    ///
    /// # Panics
    /// If there are fewer than two frames, or not as many of both.
    pub fn against(&self, reference: &Self) -> Flicker {
        assert!(self.frames.len() > 1 && self.frames.len() == reference.frames.len());
        let errors: Vec<Vec<f64>> = self
            .frames
            .iter()
            .zip(&reference.frames)
            .map(|(a, b)| a.iter().zip(b).map(|(a, b)| a - b).collect())
            .collect();
        let values = reference.frames.iter().map(Vec::len).sum::<usize>() as f64;
        let mean = reference.frames.iter().flatten().sum::<f64>() / values;
        let error = errors.iter().flatten().map(|e| e.abs()).sum::<f64>() / values;
        let mut change = 0.0;
        for pair in errors.windows(2) {
            let apart = pair[0].iter().zip(&pair[1]).map(|(a, b)| (b - a).abs());
            change += apart.sum::<f64>();
        }
        let pairs = values * (errors.len() - 1) as f64 / errors.len() as f64;
        Flicker {
            error: error / mean,
            change: change / pairs / mean,
        }
    }
}
