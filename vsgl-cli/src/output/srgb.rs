//! The transfer curve of sRGB.
//!
//! Source: IEC 61966-2-1:1999.

/// Linear value of an encoded one, both 0..=1.
pub fn decode(encoded: f32) -> f32 {
    if encoded <= 0.04045 {
        encoded / 12.92
    } else {
        ((encoded + 0.055) / 1.055).powf(2.4)
    }
}

/// Encoded value of a linear one; what lies outside 0..=1 is clamped, NaN is 0.
pub fn encode(linear: f32) -> f32 {
    let linear = if linear > 0.0 { linear.min(1.0) } else { 0.0 };
    if linear <= 0.003_130_8 {
        linear * 12.92
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}

/// The nearest of the 256 codes.
pub fn code(linear: f32) -> u8 {
    (encode(linear) * 255.0 + 0.5) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_codes_round_trip() {
        for byte in 0..=255u8 {
            assert_eq!(code(decode(f32::from(byte) / 255.0)), byte);
        }
        assert_eq!(code(f32::NAN), 0);
        assert_eq!((code(-1.0), code(f32::INFINITY)), (0, 255));
        // 18 % grey is code 118.
        assert_eq!(code(0.18), 118);
    }
}
