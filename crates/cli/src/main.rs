//! `stickslip`, the program: all of it is in the library beside, which Python runs too.

use std::process::ExitCode;

fn main() -> ExitCode {
    stickslip_cli::main()
}
