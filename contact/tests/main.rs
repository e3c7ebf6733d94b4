//! Tests of the contact solvers, of the domain, the path, stresses and derivatives.

mod dilute;
mod domain;
mod ellipse;
mod hardness;
mod levels;
mod mirror;
mod own_solver;
mod path;
mod periodic;
mod random_cases;
mod random_domains;
mod random_problems;
mod random_rough;
mod sensitivities;
mod shortcuts;
mod solvers;
mod stiffening;
mod stress;
mod summary_and_warnings;
mod texture;
mod two_bodies;
mod wear;
