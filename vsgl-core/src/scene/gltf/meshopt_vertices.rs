//! Vertices packed by `EXT_meshopt_compression`: bytes of neighbouring vertices differ by little.

/// Elements whose deltas share a width.
const GROUP: usize = 16;
/// Bytes of a block at most.
const BLOCK_BYTES: usize = 8192;
/// Elements of a block at most.
const BLOCK: usize = 256;
/// Bytes at the end of the data at least.
const TAIL: usize = 32;

/// Unpacks `count` elements of `stride` bytes, a multiple of 4 up to 256; none if the data are not sound.
///
/// Source: Khronos Group, `EXT_meshopt_compression`, appendix A, "Mode 0: attributes", version 0.
pub(super) fn vertices(data: &[u8], count: usize, stride: usize) -> Option<Vec<u8>> {
    let (&0xa0, data) = data.split_first()? else {
        return None;
    };
    let end = data.len().checked_sub(stride.max(TAIL))?;
    let (mut data, tail) = data.split_at(end);
    let mut last = tail[tail.len() - stride..].to_vec();
    // Two bits for each group of a byte are the least that data can be.
    if (count / (4 * GROUP)).checked_mul(stride)? > data.len() {
        return None;
    }
    let mut elements = vec![0; count.checked_mul(stride)?];
    let block = (BLOCK_BYTES / stride / GROUP * GROUP).min(BLOCK);
    for block in elements.chunks_mut(block * stride) {
        for (byte, last) in last.iter_mut().enumerate() {
            unpack_byte(&mut data, block, byte, stride, last)?;
        }
    }
    data.is_empty().then_some(elements)
}

/// One byte of all elements of a block.
fn unpack_byte(
    data: &mut &[u8],
    block: &mut [u8],
    byte: usize,
    stride: usize,
    last: &mut u8,
) -> Option<()> {
    let groups = (block.len() / stride).div_ceil(GROUP);
    let widths = take(data, groups.div_ceil(4))?;
    for (group, elements) in block.chunks_mut(GROUP * stride).enumerate() {
        let deltas = match widths[group / 4] >> (2 * (group % 4)) & 3 {
            0 => [0; GROUP],
            1 => narrow::<2>(data)?,
            2 => narrow::<4>(data)?,
            _ => *take(data, GROUP)?.first_chunk()?,
        };
        for (element, delta) in elements.chunks_mut(stride).zip(deltas) {
            // Zigzag: even numbers up, odd ones down.
            let delta = (delta >> 1) ^ (delta & 1).wrapping_neg();
            *last = last.wrapping_add(delta);
            element[byte] = *last;
        }
    }
    Some(())
}

/// Deltas of a few bits each; those with all bits set stand, whole, behind the others.
fn narrow<const BITS: usize>(data: &mut &[u8]) -> Option<[u8; GROUP]> {
    let full = (1u8 << BITS) - 1;
    let packed = take(data, GROUP * BITS / 8)?;
    let mut deltas = [0; GROUP];
    for (i, delta) in deltas.iter_mut().enumerate() {
        let place = i * BITS;
        let bits = packed[place / 8] >> (8 - BITS - place % 8) & full;
        *delta = if bits == full {
            take(data, 1)?[0]
        } else {
            bits
        };
    }
    Some(deltas)
}

fn take<'a>(data: &mut &'a [u8], count: usize) -> Option<&'a [u8]> {
    let (head, rest) = data.split_at_checked(count)?;
    *data = rest;
    Some(head)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Header, blocks, and the tail with the first element.
    fn packed(blocks: &[u8], first: [u8; 4]) -> Vec<u8> {
        let mut data = vec![0xa0];
        data.extend(blocks);
        data.resize(data.len() + TAIL - 4, 0);
        data.extend(first);
        data
    }

    #[test]
    fn deltas_of_every_width() {
        let mut blocks = vec![0];
        // Byte 1: 2 bits, the first three +1 (2), -1 (1), and 3 for what follows.
        blocks.extend([1, 0b10_01_11_00, 0, 0, 0, 200]);
        // Byte 2: 4 bits.
        blocks.extend([2, 0x2f, 0x10, 0, 0, 0, 0, 0, 0, 99]);
        // Byte 3: whole.
        blocks.extend([3, 255, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
        let data = packed(&blocks, [9, 10, 20, 30]);
        let elements = vertices(&data, 4, 4).unwrap();
        let expected = [
            [9, 11, 21, 158],
            [9, 10, 227, 158],
            [9, 110, 226, 159],
            [9, 110, 226, 159],
        ];
        assert_eq!(elements, expected.as_flattened());
        for length in 0..data.len() {
            assert_eq!(vertices(&data[..length], 4, 4), None);
        }
        assert_eq!(vertices(&data, 300, 4), None);
        let mut later = data.clone();
        later[0] = 0xa1;
        assert_eq!(vertices(&later, 4, 4), None);
    }

    #[test]
    fn blocks_go_on_where_the_last_ended() {
        // 300 elements: a block of 256 and one of 44, whose bytes take 16 and 3 groups.
        let mut blocks = Vec::new();
        for byte in 0..4 {
            blocks.extend([if byte == 0 { 1 } else { 0 }, 0, 0, 0]);
            if byte == 0 {
                blocks.extend([0b10_10_10_10; 4]);
            }
        }
        blocks.extend([0; 4]);
        let elements = vertices(&packed(&blocks, [1, 2, 3, 4]), 300, 4).unwrap();
        assert_eq!(elements[..8], [2, 2, 3, 4, 3, 2, 3, 4]);
        assert_eq!(elements[299 * 4..], [17, 2, 3, 4]);
    }

    #[test]
    fn counts_beyond_the_data_take_no_memory() {
        assert_eq!(vertices(&packed(&[0; 100], [0; 4]), 1 << 31, 256), None);
    }
}
