//! The `virtwall` command.
fn main() {}
