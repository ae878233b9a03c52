//! Values of several parts, such as `--spot px,py,pz:tx,ty,tz:I:OUTER`.

use std::fmt;
use std::ops::Range;

/// Width and height of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
}

impl Size {
    /// Largest side.
    pub const SIDE_MAX: u32 = 65_536;

    /// Reads `WIDTHxHEIGHT`.
    ///
    /// # Errors
    /// What would be accepted.
    pub fn parse(word: &str) -> Result<Self, String> {
        let side = |part: &str| {
            let side = part.parse().ok();
            side.filter(|side| (1..=Self::SIDE_MAX).contains(side))
        };
        let sides = word.split_once('x').map(|(w, h)| (side(w), side(h)));
        let Some((Some(width), Some(height))) = sides else {
            let most = Self::SIDE_MAX;
            return Err(format!(
                "give WIDTHxHEIGHT, such as 1280x720, each from 1 to {most}"
            ));
        };
        Ok(Self { width, height })
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}x{}", self.width, self.height)
    }
}

/// Eye and target of a camera in world space, in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LookAt {
    /// Where the camera is.
    pub eye: [f64; 3],
    /// What it looks at.
    pub target: [f64; 3],
}

impl LookAt {
    /// Reads `ex,ey,ez:tx,ty,tz`.
    ///
    /// # Errors
    /// What would be accepted.
    pub fn parse(word: &str) -> Result<Self, String> {
        let parts: Vec<&str> = word.split(':').collect();
        let [eye, target] = parts[..] else {
            return Err("give ex,ey,ez:tx,ty,tz, two points".into());
        };
        let [eye, target] = [point(eye)?, point(target)?];
        if eye == target {
            return Err("eye and target are one point; give two".into());
        }
        Ok(Self { eye, target })
    }
}

impl fmt::Display for LookAt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", list(self.eye), list(self.target))
    }
}

/// A spot light in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Where it is, in metres.
    pub position: [f64; 3],
    /// What it points at, in metres.
    pub target: [f64; 3],
    /// Radiant intensity on the axis \[W/sr\].
    pub intensity: [f64; 3],
    /// Half angle beyond which it is dark, in degrees.
    pub outer: f64,
    /// Half angle up to which the intensity is full, in degrees; none: a hard edge.
    pub inner: Option<f64>,
}

/// Largest outer half angle of a spot in degrees.
const OUTER_MAX: f64 = 90.0;

impl Spot {
    /// Reads `px,py,pz:tx,ty,tz:I:OUTER[:INNER]`.
    ///
    /// # Errors
    /// What would be accepted.
    pub fn parse(word: &str) -> Result<Self, String> {
        let parts: Vec<&str> = word.split(':').collect();
        if !(4..=5).contains(&parts.len()) {
            let form = "px,py,pz:tx,ty,tz:I:OUTER";
            return Err(format!("give {form} or {form}:INNER"));
        }
        let position = point(parts[0])?;
        let target = point(parts[1])?;
        if position == target {
            return Err("position and target are one point; give two".into());
        }
        let outer = half_angle(parts[3], OUTER_MAX)?;
        if outer == 0.0 {
            return Err("OUTER is 0; give a half angle above it".into());
        }
        Ok(Self {
            position,
            target,
            intensity: intensity(parts[2])?,
            outer,
            inner: parts
                .get(4)
                .map(|word| half_angle(word, outer))
                .transpose()?,
        })
    }
}

impl fmt::Display for Spot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (position, target) = (list(self.position), list(self.target));
        let intensity = list(self.intensity);
        write!(f, "{position}:{target}:{intensity}:{}", self.outer)?;
        self.inner.map_or(Ok(()), |inner| write!(f, ":{inner}"))
    }
}

/// A point light in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Where it is, in metres.
    pub position: [f64; 3],
    /// Radiant intensity \[W/sr\].
    pub intensity: [f64; 3],
}

impl Point {
    /// Reads `px,py,pz:I`.
    ///
    /// # Errors
    /// What would be accepted.
    pub fn parse(word: &str) -> Result<Self, String> {
        let Some((position, strength)) = word.split_once(':') else {
            return Err("give px,py,pz:I, a point and a radiant intensity".into());
        };
        Ok(Self {
            position: point(position)?,
            intensity: intensity(strength)?,
        })
    }
}

impl fmt::Display for Point {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", list(self.position), list(self.intensity))
    }
}

/// A directional light in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// The direction that its light travels in, of any length.
    pub direction: [f64; 3],
    /// Irradiance of a surface that faces it \[W/m²\].
    pub irradiance: [f64; 3],
}

impl Sun {
    /// Reads `dx,dy,dz:E`.
    ///
    /// # Errors
    /// What would be accepted.
    pub fn parse(word: &str) -> Result<Self, String> {
        let Some((direction, strength)) = word.split_once(':') else {
            return Err("give dx,dy,dz:E, a direction and an irradiance".into());
        };
        let direction = point(direction)?;
        if direction == [0.0; 3] {
            return Err("the direction is 0,0,0; give the one that the light travels in".into());
        }
        Ok(Self {
            direction,
            irradiance: amount(strength, "irradiance", "W/m²")?,
        })
    }
}

impl fmt::Display for Sun {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", list(self.direction), list(self.irradiance))
    }
}

/// Reads a vertical field of view in degrees.
///
/// # Errors
/// What would be accepted.
pub(super) fn field_of_view(word: &str) -> Result<f64, String> {
    let degrees = word.parse().ok();
    degrees
        .filter(|d| (0.01..=170.0).contains(d))
        .ok_or_else(|| "give a full angle from 0.01 to 170 degrees".into())
}

/// Reads a time in seconds.
///
/// # Errors
/// What would be accepted.
pub(super) fn seconds(word: &str) -> Result<f64, String> {
    let seconds = word.parse().ok();
    seconds
        .filter(|s: &f64| s.is_finite())
        .ok_or_else(|| "give a number of seconds".into())
}

/// Reads a length of time in seconds, above 0.
///
/// # Errors
/// What would be accepted.
pub(super) fn duration(word: &str) -> Result<f64, String> {
    let seconds = word.parse().ok();
    seconds
        .filter(|s: &f64| *s > 0.0 && *s <= 1e6)
        .ok_or_else(|| "give a number of seconds above 0, at most a million".into())
}

/// Reads a range of samples `A:B`.
///
/// # Errors
/// What would be accepted.
pub(super) fn samples(word: &str) -> Result<Range<u32>, String> {
    let ends = word.split_once(':');
    let range = ends.and_then(|(a, b)| Some(a.parse().ok()?..b.parse().ok()?));
    range
        .filter(|r: &Range<u32>| !r.is_empty())
        .ok_or_else(|| "give A:B, such as 0:64, with A below B".into())
}

/// Reads a length of time with its unit, `200ms` or `1.5s`; without a unit it is seconds.
///
/// # Errors
/// What would be accepted.
pub(super) fn budget(word: &str) -> Result<f64, String> {
    let (number, unit) = match (word.strip_suffix("ms"), word.strip_suffix('s')) {
        (Some(number), _) => (number, 1e-3),
        (None, Some(number)) => (number, 1.0),
        (None, None) => (word, 1.0),
    };
    let seconds = number.trim().parse().ok().map(|n: f64| n * unit);
    seconds
        .filter(|s| (1e-6..=1e6).contains(s))
        .ok_or_else(|| "give a time such as 200ms or 1.5s".into())
}

/// Reads a share in percent, `5%` or `5`.
///
/// # Errors
/// What would be accepted.
pub(super) fn percent(word: &str) -> Result<f64, String> {
    let number = word.strip_suffix('%').unwrap_or(word);
    let percent = number.trim().parse().ok();
    percent
        .filter(|p: &f64| (1e-3..=1e3).contains(p))
        .ok_or_else(|| "give an error in percent, such as 5%".into())
}

fn point(word: &str) -> Result<[f64; 3], String> {
    let problem = || format!("`{word}` is no point; give three numbers x,y,z in metres");
    let coordinates = numbers(word).ok_or_else(problem)?;
    coordinates.try_into().map_err(|_| problem())
}

fn intensity(word: &str) -> Result<[f64; 3], String> {
    amount(word, "intensity", "W/sr")
}

/// One number for all three colours, or three.
fn amount(word: &str, name: &str, unit: &str) -> Result<[f64; 3], String> {
    let values = numbers(word).filter(|v| v.iter().all(|i| (0.0..=1e30).contains(i)));
    match values.as_deref() {
        Some(&[grey]) => Ok([grey; 3]),
        Some(&[r, g, b]) => Ok([r, g, b]),
        _ => Err(format!(
            "`{word}` is no {name}; give one number or r,g,b in {unit}, each at least 0"
        )),
    }
}

fn half_angle(word: &str, most: f64) -> Result<f64, String> {
    let degrees = word.parse().ok();
    degrees.filter(|d| (0.0..=most).contains(d)).ok_or_else(|| {
        format!("`{word}` does not fit; give a half angle from 0 to {most} degrees (INNER at most OUTER)")
    })
}

/// Finite numbers separated by commas.
fn numbers(word: &str) -> Option<Vec<f64>> {
    let number = |part: &str| part.parse().ok().filter(|n: &f64| n.is_finite());
    word.split(',').map(number).collect()
}

fn list([x, y, z]: [f64; 3]) -> String {
    format!("{x},{y},{z}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_two_whole_numbers() {
        let size = Size {
            width: 640,
            height: 360,
        };
        assert_eq!(Size::parse("640x360"), Ok(size));
        assert_eq!(size.to_string(), "640x360");
        for bad in [
            "0x0",
            "1e9x1e9",
            "-1x5",
            "NaNxNaN",
            "640",
            "x",
            "640x360x1",
            "70000x1",
        ] {
            assert!(Size::parse(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn spots_and_cameras_round_trip() {
        for word in [
            "0,-1.5,100000.25:1,2,3:9,8,7:30",
            "0,0,0:0,0,-1:5,5,5:80:25.5",
        ] {
            assert_eq!(Spot::parse(word).map(|s| s.to_string()), Ok(word.into()));
        }
        let word = "1,-2.5,3:9,8,7";
        assert_eq!(Point::parse(word).map(|p| p.to_string()), Ok(word.into()));
        assert_eq!(Sun::parse(word).map(|s| s.to_string()), Ok(word.into()));
        let grey = Spot::parse("0,0,0:0,0,1:7:30").map(|s| s.intensity);
        assert_eq!(grey, Ok([7.0; 3]));
        let word = "-278,273,800:-278,273,-280";
        assert_eq!(LookAt::parse(word).map(|l| l.to_string()), Ok(word.into()));
    }

    #[test]
    fn samples_are_a_range() {
        assert_eq!(samples("8:24"), Ok(8..24));
        for bad in [
            "",
            "8",
            "8:",
            ":8",
            "8:8",
            "24:8",
            "-8:8",
            "8:NaN",
            "1:2:3",
            "0:9999999999",
        ] {
            assert!(samples(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn nonsense_is_refused() {
        for bad in [
            "",
            "0,0,0:0,0,1:7",
            "0,0,0:0,0,0:7:30",
            "0,0,NaN:0,0,1:7:30",
            "0,0,inf:0,0,1:7:30",
            "0,0:0,0,1:7:30",
            "0,0,0:0,0,1:-7:30",
            "0,0,0:0,0,1:1,2:30",
            "0,0,0:0,0,1:7:0",
            "0,0,0:0,0,1:7:90.5",
            "0,0,0:0,0,1:7:30:31",
            "0,0,0:0,0,1:7:30:20:10",
        ] {
            assert!(Spot::parse(bad).is_err(), "{bad}");
        }
        for bad in [
            "",
            "0,0,0",
            "0,0:1",
            "0,0,0:-1",
            "0,0,0:1,2",
            "0,0,NaN:1",
            "0,0,1:1:1",
            "0,0,1:inf",
        ] {
            assert!(Point::parse(bad).is_err(), "{bad}");
            assert!(Sun::parse(bad).is_err(), "{bad}");
        }
        assert!(Sun::parse("0,0,0:1").is_err());
        for bad in ["", "0,0,0", "0,0,0:0,0,0", "0,0,0:1,1", "a,b,c:d,e,f"] {
            assert!(LookAt::parse(bad).is_err(), "{bad}");
        }
        for bad in ["0", "180", "NaN", "-40", "inf"] {
            assert!(field_of_view(bad).is_err(), "{bad}");
        }
    }
}
