//! Elimination with the neighbours of each vertex as bits: for vertices that are few and have many.
//!
//! Joining the neighbours of a vertex pairwise is an *or* of rows, as many words long as there are vertices by 64, however many
//! neighbours they have.

use crate::elimination::Elimination;
use crate::vectors::{OverLanes, Vectors};

/// How many vertices a word has bits for.
const WORD: usize = u64::BITS as usize;

/// A vertex's degree is above these bits of its key, its place in the rows below them: the least key is that of the vertex with
/// the fewest neighbours, of several the first.
const PLACE_BITS: u32 = 16;

/// The key of a vertex that is gone.
const GONE: u32 = u32::MAX;

/// The neighbours that each vertex has left, as rows of bits.
#[derive(Debug)]
pub(crate) struct Bits {
    vertices: Vec<u32>,
    /// Words in a row.
    words: usize,
    rows: Vec<u64>,
}

impl Bits {
    /// The rows of these vertices, of so many that there are. They are fewer than 2¹⁶, and have neighbours among themselves alone.
    pub(crate) fn new<N: Iterator<Item = u32>>(
        vertices: &[u32],
        count: usize,
        neighbours: impl Fn(u32) -> N,
    ) -> Self {
        debug_assert!(vertices.len() < 1 << PLACE_BITS);
        let words = vertices.len().div_ceil(WORD);
        let mut place_of = vec![0_u32; count];
        for (&v, place) in vertices.iter().zip(0..) {
            place_of[v as usize] = place;
        }
        let mut rows = vec![0; words * vertices.len()];
        for (place, &v) in vertices.iter().enumerate() {
            for to in neighbours(v).map(|u| place_of[u as usize] as usize).filter(|&to| to != place) {
                rows[place * words + to / WORD] |= 1 << (to % WORD);
            }
        }
        Self { vertices: vertices.to_vec(), words, rows }
    }

    /// Eliminates all.
    pub(crate) fn eliminate(self, done: &mut Elimination) {
        Vectors::here().run(Work { left: self, done });
    }
}

struct Work<'a> {
    left: Bits,
    done: &'a mut Elimination,
}

impl OverLanes for Work<'_> {
    #[inline(always)]
    fn run(self) {
        let Self { left: Bits { vertices, words, mut rows }, done } = self;
        let row_of = |place: usize| place * words..(place + 1) * words;
        let degree = |place: usize| rows[row_of(place)].iter().map(|word| word.count_ones()).sum::<u32>();
        let mut keys: Vec<u32> =
            (0..vertices.len()).map(|place| degree(place) << PLACE_BITS | place as u32).collect();
        // The words of the row under work that are not empty, and its neighbours.
        let mut own: Vec<(usize, u64)> = Vec::with_capacity(words);
        let mut neighbours: Vec<u32> = Vec::with_capacity(vertices.len());
        for left in (1..=vertices.len()).rev() {
            let least = keys.iter().copied().fold(GONE, u32::min);
            if least >> PLACE_BITS >= left as u32 - 1 {
                break;
            }
            let place = place_in(least);
            keys[place] = GONE;
            own.clear();
            neighbours.clear();
            for (k, &word) in rows[row_of(place)].iter().enumerate().filter(|(_, word)| **word != 0) {
                own.push((k, word));
                let mut rest = word;
                while rest != 0 {
                    neighbours.push((k * WORD) as u32 + rest.trailing_zeros());
                    rest &= rest - 1;
                }
            }
            for to in neighbours.iter().map(|&to| to as usize) {
                let row = &mut rows[row_of(to)];
                let mut more = 0;
                for &(k, word) in &own {
                    let new = word & !row[k];
                    row[k] |= word;
                    more += new.count_ones();
                }
                // It is no neighbour of itself, and the one that goes is none any more.
                row[to / WORD] &= !(1 << (to % WORD));
                row[place / WORD] &= !(1 << (place % WORD));
                keys[to] = keys[to] + (more << PLACE_BITS) - (2 << PLACE_BITS);
            }
            done.push(vertices[place], neighbours.iter().map(|&to| vertices[to as usize]));
        }
        // All that are left are each other's neighbours.
        let places = keys.iter().filter(|&&key| key != GONE).map(|&key| place_in(key));
        let rest: Vec<u32> = places.map(|place| vertices[place]).collect();
        for (k, &v) in rest.iter().enumerate() {
            done.push(v, rest[k + 1..].iter().copied());
        }
    }
}

#[inline(always)]
fn place_in(key: u32) -> usize {
    (key & ((1 << PLACE_BITS) - 1)) as usize
}
