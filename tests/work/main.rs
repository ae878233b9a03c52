//! What is saved, counted. Times are those of the whole process, so the tests here run one after the other, and nothing else is
//! in this target.

mod shares;
