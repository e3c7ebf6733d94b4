//! The program as seen by a user: its exit codes, its output, and the files that it leaves.

#![expect(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test that cannot go on has failed"
)]

mod bad_command_line;
mod bad_input;
mod bad_text;
mod beyond_model;
mod cache;
mod cases;
mod damage;
mod draft;
mod draft_histories;
mod explore;
mod files;
mod find;
mod guide;
mod identify;
mod identify_adhesion;
mod identify_contacts;
mod identify_depths;
mod identify_each;
mod identify_exact;
mod identify_noise;
mod identify_plan;
mod identify_plan_files;
mod identify_readings;
mod identify_repeats;
mod identify_report;
mod identify_spring;
mod identify_stiffness;
mod identify_stopped;
mod identify_unloadings;
mod identify_validity;
mod identify_zeros;
mod interrupt;
mod keeping;
#[cfg(target_os = "linux")]
mod little_memory;
mod maps;
mod netcdf_reader;
mod odd_values;
mod periodic;
mod pictures;
mod read_back;
mod rough_maps;
mod runner;
mod schemas;
mod sensitivities;
mod solve;
mod stress_command;
mod stress_extent;
mod stress_files;
mod stress_memory;
mod stress_pictures;
mod stress_summary;
mod study;
mod study_columns;
mod study_faults;
mod study_fields;
mod study_picture;
mod study_report;
mod surface;
mod tables;
mod two_bodies;
mod wear;
mod writing;
