//! Numerical stability: the mathematics against exact values, its contracts at the edge, and its two texts.

mod accuracy;
mod directions;
mod edges;
mod lanes;
mod surfaces;
