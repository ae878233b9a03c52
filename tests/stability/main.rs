//! Numerical stability: the mathematics against exact values, and its contracts at the edge.

mod accuracy;
