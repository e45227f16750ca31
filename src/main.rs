//! The `stepover` command.

#[cfg(not(target_arch = "wasm32"))]
fn main() -> std::process::ExitCode {
    stepover::cli::run()
}

// The page's module is the library; cargo still wants every binary to exist for its target.
#[cfg(target_arch = "wasm32")]
fn main() {}
