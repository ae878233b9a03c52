//! The numbers that shaders share with core, as WGSL.

use std::collections::BTreeSet;
use std::fmt::Write;
use vsgl_core::constants::ALL;

/// Declarations of the shared constants that occur in `text`: scalars under their names, and for each polynomial `NAME` a
/// function `horner_name(x)`, the chain of [`vsgl_core::math::polynomial::horner`] written out.
pub(crate) fn shared(text: &str) -> String {
    let words: BTreeSet<&str> = text
        .split(|c: char| !c.is_ascii_alphanumeric() && c != '_')
        .collect();
    let mut out = String::new();
    for constants in ALL {
        for (name, value) in constants.scalars {
            if words.contains(name) {
                let _ = writeln!(out, "const {name}: f32 = {};", literal(*value));
            }
        }
        for (name, coefficients) in constants.polynomials {
            let name = format!("horner_{}", name.to_lowercase());
            if words.contains(name.as_str()) {
                let _ = write!(out, "fn {name}(x: f32) -> f32 {{\n    var p = ");
                for (i, coefficient) in coefficients.iter().enumerate() {
                    let head = if i == 0 { "" } else { "    p = p * x + " };
                    let _ = writeln!(out, "{head}{};", literal(*coefficient));
                }
                out.push_str("    return p;\n}\n");
            }
        }
    }
    out
}

/// The shortest decimal that reads back as the same bits, in parentheses if negative.
fn literal(value: f32) -> String {
    if value < 0.0 {
        format!("({value:e}f)")
    } else {
        format!("{value:e}f")
    }
}
