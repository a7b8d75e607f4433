//! Man pages and completions, from what the program says of its own arguments: `manual FOLDER` writes `man/*.1` and
//! `completions/*` there.

use clap_complete::{Shell, generate_to};
use std::path::PathBuf;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let folder = env::args_os().nth(1).map(PathBuf::from);
    let folder = folder.ok_or_else(|| io::Error::other("which folder? manual FOLDER"))?;
    let (man, completions) = (folder.join("man"), folder.join("completions"));
    fs::create_dir_all(&man)?;
    fs::create_dir_all(&completions)?;
    // A page for each command: stickslip.1, stickslip-run.1, …
    clap_mangen::generate_to(stickslip_cli::arguments(), man)?;
    let mut arguments = stickslip_cli::arguments();
    for shell in [Shell::Bash, Shell::Zsh, Shell::Fish] {
        generate_to(shell, &mut arguments, "stickslip", &completions)?;
    }
    Ok(())
}
