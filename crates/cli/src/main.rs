//! The program `stickslip`: a call of the library of this crate, which Python uses too.

use std::process::ExitCode;

fn main() -> ExitCode {
    stickslip_cli::main()
}
