//! Pictures of the differences.

use super::{Tier, report};
use crate::exit::Result;
use crate::interrupt;
use crate::job::Job;
use crate::output::font::Canvas;
use crate::output::legend::Scale;
use crate::output::{self, Format, Metadata, Pending};
use crate::text;
use std::path::{Path, PathBuf};
use vsgl_core::parity::{Comparison, DIFFERENT, Stage, Step, UNJUDGED};

/// Colour of another decision, or of a number that is not finite.
const OTHER: [u8; 3] = [0, 0xff, 0];
/// Colour where a decision before it differs.
const EXCUSED: [u8; 3] = [0x60, 0x70, 0x60];
const SCALE: Scale = Scale {
    ends: (1e-7, 1e-1),
    labels: &["1e-7", "1e-5", "1e-3", "1e-1"],
    marks: &[("different", OTHER), ("not rated", EXCUSED)],
};
/// Most maps that are drawn.
const MAPS_MAX: usize = 16;

/// Where pictures go.
pub(super) enum Pictures {
    /// The whole picture's differences, worst tier.
    One(Pending),
    /// All of them.
    Folder(PathBuf),
}

impl Pictures {
    /// Makes sure that files can be made.
    pub(super) fn prepare(path: &Path) -> Result<Self> {
        if path.extension().is_some() && !path.is_dir() {
            if Format::of(path)? != Format::Png {
                return Err(crate::exit::Failure::Usage(format!(
                    "{}: differences are drawn as PNG; give a name that ends in .png, or a folder",
                    path.display()
                )));
            }
            return Ok(Self::One(Pending::create(path)?));
        }
        drop(Pending::create(&path.join("strict-frame-image.png"))?);
        Ok(Self::Folder(path.to_owned()))
    }

    /// Draws, and returns the paths.
    pub(super) fn write(self, tiers: &[Tier], job: &Job) -> Result<Vec<String>> {
        let steps = || tiers.iter().flat_map(|tier| tier.steps.iter().flatten());
        let mut written = Vec::new();
        match self {
            Self::One(file) => {
                let frames = steps().filter(|s| s.stage == Stage::Frame);
                let drawn: Vec<Vec<f32>> = frames.filter_map(|s| errors(&s.comparison)).collect();
                let (width, height) = job.view.pixels();
                let count = width as usize * height as usize;
                let worst = drawn.into_iter().reduce(merge);
                let canvas = draw(
                    &worst.unwrap_or_else(|| vec![DIFFERENT; count]),
                    width as usize,
                );
                written.push(file.path().to_string_lossy().into_owned());
                save(file, &canvas, job)?;
            }
            Self::Folder(folder) => {
                for tier in tiers {
                    for step in tier.steps.iter().flatten() {
                        interrupt::check()?;
                        let Some(canvas) = picture(step) else {
                            continue;
                        };
                        let (tier, stage) = (tier.tolerance.name, step.stage);
                        let name = format!("{tier}-{stage}-{}.png", step.comparison.resource);
                        let file = Pending::create(&folder.join(name))?;
                        written.push(file.path().to_string_lossy().into_owned());
                        save(file, &canvas, job)?;
                    }
                }
            }
        }
        Ok(written)
    }
}

fn save(file: Pending, canvas: &Canvas, job: &Job) -> Result<()> {
    let metadata = Metadata {
        software: output::software(),
        command: text::shell(&report::command_words(job)),
        ..Metadata::default()
    };
    let (width, height) = (canvas.width as u32, canvas.height as u32);
    file.write(|file| output::png::write(file, width, height, &canvas.pixels, &metadata))
}

/// The differences of a resource that is a picture or a row of maps.
fn picture(step: &Step) -> Option<Canvas> {
    let comparison = &step.comparison;
    let errors = errors(comparison)?;
    let [width, second] = comparison.head[..] else {
        return None;
    };
    let width = width as usize;
    if comparison.resource != "rsm" {
        return Some(draw(&errors, width));
    }
    let maps = (second as usize).min(MAPS_MAX);
    // Side by side, as they lie one after the other.
    let row =
        |y: usize| (0..maps * width).map(move |x| ((x / width * width) + y) * width + x % width);
    let indices = (0..width).flat_map(row);
    let beside: Vec<f32> = indices.map(|i| errors[i]).collect();
    Some(draw(&beside, maps * width))
}

/// The worst over all columns of each pixel or texel; none of what is no picture.
fn errors(comparison: &Comparison) -> Option<Vec<f32>> {
    let [width, second] = comparison.head[..] else {
        return None;
    };
    let (width, second) = (width as usize, second as usize);
    let count = match comparison.resource {
        "gbuffer" | "radiance" | "image" => width * second,
        "rsm" => width * width * second,
        _ => return None,
    };
    let columns = comparison.columns.iter().filter(|c| c.entries == count);
    let errors = columns.map(|c| c.errors.clone()).reduce(merge);
    errors.filter(|_| count > 0)
}

/// The worse of each two; anything is worse than what could not be judged.
fn merge(mut a: Vec<f32>, b: Vec<f32>) -> Vec<f32> {
    a.iter_mut().zip(b).for_each(|(a, b)| *a = a.max(b));
    a
}

fn draw(errors: &[f32], width: usize) -> Canvas {
    let mut canvas = SCALE.canvas(width, errors.len() / width.max(1));
    for (index, &error) in errors.iter().enumerate() {
        let color = match error {
            DIFFERENT => OTHER,
            UNJUDGED => EXCUSED,
            0.0 => [0; 3],
            _ => SCALE.color(f64::from(error)),
        };
        canvas.set(index % width, index / width, color);
    }
    canvas
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_have_the_colours_of_the_legend() {
        let errors = merge(
            vec![0.0, 1e-5, UNJUDGED, UNJUDGED],
            vec![0.0, 1e-6, DIFFERENT, UNJUDGED],
        );
        let canvas = draw(&errors, 2);
        let pixel = |x: usize, y: usize| canvas.pixels[y * canvas.width + x];
        assert_eq!(pixel(0, 0), [0; 3]);
        assert_eq!(pixel(1, 0), SCALE.color(1e-5));
        assert_eq!((pixel(0, 1), pixel(1, 1)), (OTHER, EXCUSED));
        assert_ne!(SCALE.color(1e-7), [0; 3]);
    }
}
