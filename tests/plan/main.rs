//! What the plan leaves out, why, and that nobody sees it.

mod pruning;
mod rules;
mod shares;
