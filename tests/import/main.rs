//! Reading files: real ones from many sources, small ones written for the purpose, and broken ones.

mod corpus;
mod formats;
mod hostile;

/// The bytes of a file in `tests/data`.
fn data(file: &str) -> Vec<u8> {
    let path = format!("{}/tests/data/{file}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
}
