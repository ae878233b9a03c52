//! Elementary functions and vectors, from operations that every backend rounds alike.

mod coefficients;
pub mod elementary;
pub mod fold;
pub mod moments;
pub mod polynomial;
pub mod sobol;
pub mod vec;
