//! SHA-256 (FIPS 180-4, section 6.2): by it the page's policy names the one script and the one style that may run.

/// Fractional parts of the cube roots of the first 64 primes, or of the square roots: the standard's constants.
fn fractions<const N: usize>(root: impl Fn(f64) -> f64) -> [u32; N] {
    let prime = |n: &u32| {
        (2..*n)
            .take_while(|d| d * d <= *n)
            .all(|d| !n.is_multiple_of(d))
    };
    let mut primes = (2_u32..).filter(prime);
    std::array::from_fn(|_| {
        let value = root(f64::from(primes.next().unwrap_or(2)));
        // 32 bits of a root below 8 need 35 of the 53 that there are.
        (value.fract() * 4_294_967_296.0) as u32
    })
}

/// The digest of these bytes.
pub(super) fn sha256(bytes: &[u8]) -> [u8; 32] {
    let rounds: [u32; 64] = fractions(f64::cbrt);
    let mut hash: [u32; 8] = fractions(f64::sqrt);
    let mut padded = bytes.to_vec();
    padded.push(0x80);
    while padded.len() % 64 != 56 {
        padded.push(0);
    }
    padded.extend((8 * bytes.len() as u64).to_be_bytes());
    for block in padded.chunks_exact(64) {
        let mut words = [0_u32; 64];
        for (word, four) in words.iter_mut().zip(block.chunks_exact(4)) {
            *word = four.iter().fold(0, |all, &byte| all << 8 | u32::from(byte));
        }
        for t in 16..64 {
            let (near, far) = (words[t - 2], words[t - 15]);
            let near = near.rotate_right(17) ^ near.rotate_right(19) ^ near >> 10;
            let far = far.rotate_right(7) ^ far.rotate_right(18) ^ far >> 3;
            words[t] = near
                .wrapping_add(words[t - 7])
                .wrapping_add(far)
                .wrapping_add(words[t - 16]);
        }
        let mut state = hash;
        for (word, round) in words.iter().zip(rounds) {
            let [a, b, c, d, e, f, g, h] = state;
            let sum = e.rotate_right(6) ^ e.rotate_right(11) ^ e.rotate_right(25);
            let chosen = e & f ^ !e & g;
            let first = h
                .wrapping_add(sum)
                .wrapping_add(chosen)
                .wrapping_add(round)
                .wrapping_add(*word);
            let sum = a.rotate_right(2) ^ a.rotate_right(13) ^ a.rotate_right(22);
            let most = a & b ^ a & c ^ b & c;
            let second = sum.wrapping_add(most);
            state = [
                first.wrapping_add(second),
                a,
                b,
                c,
                d.wrapping_add(first),
                e,
                f,
                g,
            ];
        }
        for (total, word) in hash.iter_mut().zip(state) {
            *total = total.wrapping_add(word);
        }
    }
    let mut digest = [0; 32];
    for (four, word) in digest.chunks_exact_mut(4).zip(hash) {
        four.copy_from_slice(&word.to_be_bytes());
    }
    digest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hex(bytes: &[u8]) -> String {
        sha256(bytes).iter().map(|b| format!("{b:02x}")).collect()
    }

    #[test]
    fn vectors_of_the_standard() {
        let vectors: [(&[u8], &str); 3] = [
            (
                b"",
                "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855",
            ),
            (
                b"abc",
                "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad",
            ),
            (
                b"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq",
                "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1",
            ),
        ];
        for (bytes, digest) in vectors {
            assert_eq!(hex(bytes), digest);
        }
        // All lengths around the end of a block are padded.
        let lengths: Vec<_> = (50..70).map(|n| hex(&vec![b'a'; n])).collect();
        let mut distinct = lengths.clone();
        distinct.sort();
        distinct.dedup();
        assert_eq!(distinct.len(), lengths.len());
    }
}
