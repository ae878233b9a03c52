//! Data packed by `EXT_meshopt_compression`.
//!
//! Source: Khronos Group, `EXT_meshopt_compression`, appendices A (bitstream) and B (filters). Its author is Arseny
//! Kapoulkine.

use super::meshopt_filters::{Filter, restore};
use super::meshopt_indices::{sequence, triangles};
use super::meshopt_vertices::vertices;
use gltf::json::Value;

/// Name of the extension.
pub(super) const NAME: &str = "EXT_meshopt_compression";

/// What a file says about a packed range of bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Packed {
    pub(super) buffer: usize,
    pub(super) start: u64,
    pub(super) length: u64,
    stride: usize,
    count: usize,
    mode: Mode,
    filter: Filter,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Mode {
    Attributes,
    Triangles,
    Indices,
}

impl Packed {
    /// Reads and checks what the extension says; otherwise the member that is wrong.
    pub(super) fn of(extension: &Value) -> Result<Self, &'static str> {
        let number = |name: &str| extension[name].as_u64();
        let small = |name: &str, most: u64| number(name).filter(|&n| n <= most);
        let mode = match extension["mode"].as_str() {
            Some("ATTRIBUTES") => Mode::Attributes,
            Some("TRIANGLES") => Mode::Triangles,
            Some("INDICES") => Mode::Indices,
            _ => return Err("mode"),
        };
        let stride = small("byteStride", 256).ok_or("byteStride")? as usize;
        let filter = match (extension["filter"].as_str(), mode) {
            (None | Some("NONE"), _) => Filter::None,
            (Some("OCTAHEDRAL"), Mode::Attributes) if stride == 4 || stride == 8 => {
                Filter::Octahedral
            }
            (Some("QUATERNION"), Mode::Attributes) if stride == 8 => Filter::Quaternion,
            (Some("EXPONENTIAL"), Mode::Attributes) => Filter::Exponential,
            _ => return Err("filter"),
        };
        let fits = match mode {
            Mode::Attributes => stride > 0 && stride.is_multiple_of(4),
            Mode::Triangles | Mode::Indices => stride == 2 || stride == 4,
        };
        if !fits {
            return Err("byteStride");
        }
        let count = small("count", 1 << 31).ok_or("count")? as usize;
        if mode == Mode::Triangles && !count.is_multiple_of(3) {
            return Err("count");
        }
        let start = match &extension["byteOffset"] {
            Value::Null => 0,
            value => value.as_u64().ok_or("byteOffset")?,
        };
        Ok(Self {
            buffer: small("buffer", u32::MAX.into()).ok_or("buffer")? as usize,
            start,
            length: number("byteLength").ok_or("byteLength")?,
            stride,
            count,
            mode,
            filter,
        })
    }

    /// Bytes when unpacked.
    pub(super) fn size(&self) -> u64 {
        self.count as u64 * self.stride as u64
    }

    /// Unpacks; none if the bytes are not what they should be.
    pub(super) fn unpack(&self, bytes: &[u8]) -> Option<Vec<u8>> {
        let narrow = |indices: Vec<u32>| -> Vec<u8> {
            let bytes = indices.iter().map(|index| index.to_le_bytes());
            bytes
                .flat_map(|b| b.into_iter().take(self.stride))
                .collect()
        };
        match self.mode {
            Mode::Attributes => {
                let mut elements = vertices(bytes, self.count, self.stride)?;
                restore(&mut elements, self.stride, self.filter);
                Some(elements)
            }
            Mode::Triangles => triangles(bytes, self.count).map(narrow),
            Mode::Indices => sequence(bytes, self.count).map(narrow),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Result<Packed, &'static str> {
        Packed::of(&gltf::json::deserialize::from_str(text).unwrap())
    }

    #[test]
    fn what_makes_no_sense_is_named() {
        let good = r#"{"buffer":1,"byteLength":9,"byteStride":8,"count":6,"mode":"ATTRIBUTES","filter":"QUATERNION"}"#;
        let packed = of(good).unwrap();
        assert_eq!(
            (packed.buffer, packed.start, packed.length, packed.size()),
            (1, 0, 9, 48)
        );
        for (from, to, member) in [
            (r#""ATTRIBUTES""#, r#""TRIANGLES""#, "filter"),
            (r#""QUATERNION""#, r#""COLOR""#, "filter"),
            (r#""byteStride":8"#, r#""byteStride":4"#, "filter"),
            (
                r#","filter":"QUATERNION""#,
                r#","byteStride":6"#,
                "byteStride",
            ),
            (r#""byteStride":8"#, r#""byteStride":260"#, "byteStride"),
            (r#""byteStride":8"#, r#""x":8"#, "byteStride"),
            (r#""count":6"#, r#""count":-6"#, "count"),
            (r#""count":6"#, r#""count":1e18"#, "count"),
            (
                r#""buffer":1"#,
                r#""buffer":1,"byteOffset":-1"#,
                "byteOffset",
            ),
            (r#""buffer":1,"#, "", "buffer"),
            (r#""byteLength":9,"#, "", "byteLength"),
            (r#""ATTRIBUTES""#, "7", "mode"),
        ] {
            assert_eq!(of(&good.replacen(from, to, 1)), Err(member), "{to}");
        }
    }
}
