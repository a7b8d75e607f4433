//! The program as a user drives it.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

#[path = "../support/acceptance.rs"]
mod acceptance;
#[path = "../support/folder.rs"]
mod folder;
#[path = "../support/runs.rs"]
mod runs;

mod across;
#[cfg(unix)]
mod book;
mod checkpoints;
mod command_line;
mod compare_across;
mod compare_command;
mod confined_files;
mod cycle_commands;
mod damaged_documents;
mod document_text;
mod documents;
mod extreme_numbers;
mod figures;
mod fit_command;
mod free_rasters;
mod friction_of_runs;
mod hints;
mod holds;
mod image_files;
mod image_fits;
mod interrupts;
mod load_maps;
mod origin;
mod outcomes;
mod parameters;
mod people;
mod physical_units;
mod pictures;
mod prose_numbers;
mod quantities;
mod raster_commands;
mod raster_sweeps;
mod reference;
mod refusals;
mod resume;
#[cfg(unix)]
mod slurm_scripts;
mod snaking_runs;
mod stability_commands;
mod supply_chain;
mod sweep;
mod sweep_axes;
mod table_forms;
mod terminal;
mod tip_command;
mod units_command;
mod verification;
mod verified_across;
mod verified_lines;
mod walkers;
mod walls;
mod wider_commands;
mod wider_law;
mod written_files;
