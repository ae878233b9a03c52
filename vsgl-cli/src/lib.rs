//! Render, compare and measure with virtual spherical Gaussian lights.
