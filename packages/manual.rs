//! Man pages, from what the program says of its own arguments: `stickslip-manual FOLDER` writes a page for each command
//! there, stickslip.1, stickslip-run.1 and so on.

use std::path::PathBuf;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let folder = env::args_os().nth(1).map(PathBuf::from);
    let folder = folder.ok_or_else(|| io::Error::other("which folder? stickslip-manual FOLDER"))?;
    fs::create_dir_all(&folder)?;
    clap_mangen::generate_to(stickslip_cli::arguments(), folder)
}
