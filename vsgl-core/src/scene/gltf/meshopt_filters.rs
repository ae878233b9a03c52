//! Filters of `EXT_meshopt_compression`: numbers that are stored in a form that packs better.

/// How elements were stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Filter {
    None,
    /// Unit vectors on an octahedron.
    Octahedral,
    /// Unit quaternions without their largest component.
    Quaternion,
    /// Floats of 24 bits with an exponent of eight.
    Exponential,
}

/// Restores elements of `stride` bytes in place; the stride fits the filter.
///
/// Source: Khronos Group, `EXT_meshopt_compression`, appendix B.
pub(super) fn restore(elements: &mut [u8], stride: usize, filter: Filter) {
    match (filter, stride) {
        (Filter::None, _) => {}
        (Filter::Octahedral, 4) => {
            for element in elements.as_chunks_mut::<4>().0 {
                let [x, y, z, w] = element.map(|b| f32::from(b as i8));
                let [x, y, z] = octahedral(x, y, z, 127.0);
                *element = [x, y, z, w as i32].map(|c| c as i8 as u8);
            }
        }
        (Filter::Octahedral, _) => shorts(elements, |[x, y, z, w]| {
            let [x, y, z] = octahedral(f32::from(x), f32::from(y), f32::from(z), 32767.0);
            [x as i16, y as i16, z as i16, w]
        }),
        (Filter::Quaternion, _) => shorts(elements, quaternion),
        (Filter::Exponential, _) => {
            for element in elements.as_chunks_mut::<4>().0 {
                let bits = i32::from_le_bytes(*element);
                let (exponent, mantissa) = (bits >> 24, bits << 8 >> 8);
                let value = f64::from(mantissa) * 2f64.powi(exponent);
                *element = (value as f32).to_le_bytes();
            }
        }
    }
}

fn shorts(elements: &mut [u8], restored: impl Fn([i16; 4]) -> [i16; 4]) {
    for element in elements.as_chunks_mut::<8>().0 {
        let [a, b, c, d, e, f, g, h] = *element;
        let short = |pair| i16::from_le_bytes(pair);
        let components = restored([short([a, b]), short([c, d]), short([e, f]), short([g, h])]);
        for (bytes, component) in element.as_chunks_mut::<2>().0.iter_mut().zip(components) {
            *bytes = component.to_le_bytes();
        }
    }
}

/// The unit vector, times `full`, whose octahedral coordinates are `x` and `y` where 1 is `one`.
fn octahedral(x: f32, y: f32, one: f32, full: f32) -> [i32; 3] {
    let z = one - x.abs() - y.abs();
    let fold = z.min(0.0);
    let folded = |c: f32| if c >= 0.0 { c + fold } else { c - fold };
    let (x, y) = (folded(x), folded(y));
    let scale = full / (x * x + y * y + z * z).sqrt();
    [x, y, z].map(|c| rounded(c * scale))
}

fn quaternion([x, y, z, code]: [i16; 4]) -> [i16; 4] {
    let scale = std::f32::consts::FRAC_1_SQRT_2 / f32::from(code | 3);
    let [x, y, z] = [x, y, z].map(|c| f32::from(c) * scale);
    let w = (1.0 - x * x - y * y - z * z).max(0.0).sqrt();
    let mut components = [0; 4];
    for (i, component) in [x, y, z, w].into_iter().enumerate() {
        components[((code & 3) as usize + 1 + i) % 4] = rounded(component * 32767.0) as i16;
    }
    components
}

/// To the nearest, halves away from zero; what is no number becomes 0.
fn rounded(value: f32) -> i32 {
    (value + 0.5f32.copysign(value)) as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn octahedra_fold_back_to_spheres() {
        let mut bytes = [
            [0, 0, 127, 5],
            [127, 0, 127, 5],
            [0, 127, 0, 0],
            [64, 63, 127, 1],
        ]
        .concat();
        bytes.extend([0x81, 0x81, 127, 0]);
        restore(&mut bytes, 4, Filter::Octahedral);
        let signed: Vec<i8> = bytes.iter().map(|&b| b as i8).collect();
        assert_eq!(signed[..4], [0, 0, 127, 5]);
        assert_eq!(signed[4..8], [127, 0, 0, 5]);
        assert_eq!(signed[12..16], [91, 89, 0, 1]);
        // All the way round: the south pole.
        assert_eq!(signed[16..], [0, 0, -127, 0]);
        let mut shorts: Vec<u8> = [0i16, 100, 100, 7]
            .iter()
            .flat_map(|s| s.to_le_bytes())
            .collect();
        restore(&mut shorts, 8, Filter::Octahedral);
        assert_eq!(i16::from_le_bytes([shorts[2], shorts[3]]), 32767);
        assert_eq!(i16::from_le_bytes([shorts[6], shorts[7]]), 7);
    }

    #[test]
    fn quaternions_find_their_largest_component() {
        for largest in 0..4i16 {
            let full = 32764 | 3;
            let code = (full & !3) | largest;
            let q = quaternion([full, 0, 0, code]).map(|c| f32::from(c) / 32767.0);
            let mut expected = [0.0; 4];
            expected[(largest as usize + 1) % 4] = std::f32::consts::FRAC_1_SQRT_2;
            expected[largest as usize] = std::f32::consts::FRAC_1_SQRT_2;
            for (a, b) in q.into_iter().zip(expected) {
                assert!((a - b).abs() < 1e-4, "{q:?}");
            }
        }
    }

    #[test]
    fn floats_are_mantissas_times_powers_of_two() {
        let mut bytes = Vec::new();
        for (exponent, mantissa) in [(-3i32, 5i32), (10, -3), (0, 0), (-24, 0x7f_ffff)] {
            bytes.extend((exponent << 24 | (mantissa & 0xff_ffff)).to_le_bytes());
        }
        restore(&mut bytes, 8, Filter::Exponential);
        let values: Vec<f32> = bytes
            .as_chunks()
            .0
            .iter()
            .map(|b| f32::from_le_bytes(*b))
            .collect();
        assert_eq!(values, [0.625, -3072.0, 0.0, 0.49999994]);
    }

    #[test]
    fn no_number_does_harm() {
        let mut bytes: Vec<u8> = (0..=255).collect();
        for (stride, filter) in [
            (4, Filter::Octahedral),
            (8, Filter::Octahedral),
            (8, Filter::Quaternion),
            (4, Filter::Exponential),
        ] {
            restore(&mut bytes, stride, filter);
            let mut zeros = [0; 8];
            restore(&mut zeros, stride, filter);
        }
    }
}
