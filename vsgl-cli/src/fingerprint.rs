//! Numbers that stand for everything that decides the pixels of paths.
//!
//! Not made to withstand people who look for two scenes with the same one.

use vsgl_core::data::{Columns, LightRecord, SceneData};
use vsgl_core::plan::{PathPlan, Plan};
use vsgl_core::render::View;
use vsgl_core::scene::Light;

/// Fingerprint of a scene as it was prepared, as hexadecimal digits.
#[must_use]
pub fn of_scene(scene: &SceneData) -> String {
    let mut print = Print::default();
    for number in scene.head() {
        print.word(u64::from(number));
    }
    for column in scene.columns() {
        print.bytes(column.name.as_bytes());
        print.bytes(column.bytes);
    }
    print.hex()
}

/// Fingerprint of paths: of the scene's own, lights, camera, size, what paths do, and what computes them. How many samples are
/// taken is not in it, nor which of them: sample `k` is the same anyway. None for a plan without paths.
#[must_use]
pub fn of_paths(
    scene: &str,
    lights: &[Light],
    view: &View,
    plan: &Plan,
    device: &str,
) -> Option<String> {
    let path = PathPlan {
        samples: 0,
        ..plan.path.clone()?
    };
    let lights: Vec<LightRecord> = lights.iter().map(LightRecord::from).collect();
    // Numbers are written with as many digits as tell them from all others.
    let words = format!(
        "{scene} {lights:?} {view:?} {path:?} {:?} {device}",
        plan.gbuffer
    );
    let mut print = Print::default();
    print.bytes(words.as_bytes());
    Some(print.hex())
}

/// Two sums of 64 bits over all words, each turned by what came before.
struct Print([u64; 2]);

impl Default for Print {
    fn default() -> Self {
        Self([0x6a09_e667_f3bc_c908, 0xbb67_ae85_84ca_a73b])
    }
}

impl Print {
    fn word(&mut self, word: u64) {
        let [a, b] = self.0;
        let a = (a ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let b = (b.rotate_left(23) ^ word).wrapping_mul(0xd6e8_feb8_6659_fd93);
        self.0 = [a ^ (a >> 32), b ^ (b >> 29)];
    }

    fn bytes(&mut self, bytes: &[u8]) {
        let words = bytes.chunks_exact(8);
        let mut last = [0; 8];
        last[..words.remainder().len()].copy_from_slice(words.remainder());
        for word in words {
            self.word(u64::from_le_bytes(word.try_into().unwrap_or_default()));
        }
        self.word(u64::from_le_bytes(last));
        // So that a zero at the end is told from nothing.
        self.word(bytes.len() as u64);
    }

    fn hex(mut self) -> String {
        self.word(0);
        format!("{:016x}{:016x}", self.0[0], self.0[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bit_and_the_length_count() {
        let of = |bytes: &[u8]| {
            let mut print = Print::default();
            print.bytes(bytes);
            print.hex()
        };
        let bytes: Vec<u8> = (0..37).collect();
        let mut seen = vec![of(&bytes), of(&bytes[..36]), of(&[]), of(&[0]), of(&[0, 0])];
        for bit in 0..37 * 8 {
            let mut other = bytes.clone();
            other[bit / 8] ^= 1 << (bit % 8);
            seen.push(of(&other));
        }
        let count = seen.len();
        seen.sort();
        seen.dedup();
        assert_eq!(seen.len(), count);
        assert_eq!(of(&bytes), of(&bytes));
    }
}
