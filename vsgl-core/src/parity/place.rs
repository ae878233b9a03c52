//! Where an entry of a column lies.

use crate::phase::pdf::{level_count, top_level};
use std::fmt;

/// What an index into a column stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A pixel or sample of a picture, from the top left.
    Pixel {
        /// Column.
        x: u32,
        /// Row.
        y: u32,
    },
    /// A texel of a map.
    Texel {
        /// Which map.
        map: u32,
        /// Column.
        x: u32,
        /// Row.
        y: u32,
    },
    /// A texel of a level of a map's pyramid.
    Level {
        /// Level, 0 the finest.
        level: u32,
        /// Which map.
        map: u32,
        /// Column.
        x: u32,
        /// Row.
        y: u32,
    },
    /// A map.
    Map(u32),
    /// A virtual light.
    Light(u32),
    /// A texel of all maps, by its number.
    Number(u32),
    /// An entry of any other column.
    Entry(u32),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Pixel { x, y } => write!(f, "x {x}, y {y}"),
            Self::Texel { map, x, y } => write!(f, "map {map}, x {x}, y {y}"),
            Self::Level { level, map, x, y } => write!(f, "map {map}, level {level}, x {x}, y {y}"),
            Self::Map(map) => write!(f, "map {map}"),
            Self::Light(light) => write!(f, "light {light}"),
            Self::Number(texel) => write!(f, "texel {texel}"),
            Self::Entry(entry) => write!(f, "entry {entry}"),
        }
    }
}

/// How the entries of a column are laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Layout {
    /// Row-major; the head begins with the width.
    Picture,
    /// Square maps one after the other; the head begins with their side.
    Texels,
    /// As [`Layout::Texels`], of a resource that does not know the side.
    TexelNumbers,
    /// Square maps one after the other; the head is the number of maps and their side.
    MapTexels,
    /// Levels of square maps; the head is the side of level 0 and the number of maps.
    Pyramid,
    /// One entry a map.
    Maps,
    /// One entry a virtual light.
    Lights,
    /// Anything.
    Entries,
}

impl Layout {
    /// The place of an entry of a resource with this head.
    pub(super) fn place(self, head: &[u32], index: usize) -> Place {
        let number = |i: usize| head.get(i).copied().unwrap_or(1).max(1);
        let entry = u32::try_from(index).unwrap_or(u32::MAX);
        match self {
            Self::Picture => Place::Pixel {
                x: entry % number(0),
                y: entry / number(0),
            },
            Self::Texels => {
                let [map, x, y] = square(number(0), index);
                Place::Texel { map, x, y }
            }
            Self::MapTexels => {
                let [map, x, y] = square(number(1), index);
                Place::Texel { map, x, y }
            }
            Self::TexelNumbers => Place::Number(entry),
            Self::Pyramid => level(number(0), number(1), index),
            Self::Maps => Place::Map(entry),
            Self::Lights => Place::Light(entry),
            Self::Entries => Place::Entry(entry),
        }
    }
}

/// Map, column and row of a texel of maps with this side.
fn square(side: u32, index: usize) -> [u32; 3] {
    let side = side as usize;
    [index / (side * side), index % side, index / side % side].map(|n| n as u32)
}

fn level(size: u32, maps: u32, index: usize) -> Place {
    let mut rest = index;
    for level in 0..=top_level(size) {
        let count = level_count(size, maps, level);
        if rest < count {
            let [map, x, y] = square(size >> level, rest);
            return Place::Level { level, map, x, y };
        }
        rest -= count;
    }
    Place::Entry(u32::try_from(index).unwrap_or(u32::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_counted_from_the_top_left() {
        let place = |layout: Layout, head: &[u32], index| layout.place(head, index).to_string();
        assert_eq!(place(Layout::Picture, &[16, 9], 37), "x 5, y 2");
        assert_eq!(place(Layout::Texels, &[4, 2], 16 + 6), "map 1, x 2, y 1");
        assert_eq!(
            place(Layout::Pyramid, &[4, 2], 32 + 4 + 3),
            "map 1, level 1, x 1, y 1"
        );
        assert_eq!(
            place(Layout::Pyramid, &[4, 2], 32 + 8 + 1),
            "map 1, level 2, x 0, y 0"
        );
        // Beyond the end there is no texel, and no panic.
        assert_eq!(place(Layout::Pyramid, &[4, 2], 32 + 8 + 2), "entry 42");
        assert_eq!(place(Layout::Picture, &[0, 0], 3), "x 0, y 3");
    }
}
