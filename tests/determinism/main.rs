//! The same bits, however a picture is made: threads, runs, copies, lanes.

mod bits;
mod blocks;
mod columns;
mod speed;
mod texts;
