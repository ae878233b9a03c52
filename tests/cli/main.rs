//! The program from outside: what it prints and writes, and how it ends, for good input and for bad.

mod adapters;
mod choose;
mod compare;
mod errors;
mod explain;
mod help;
mod info;
mod interrupt;
mod parity;
mod parts;
mod render;
mod run;
mod sweep;
