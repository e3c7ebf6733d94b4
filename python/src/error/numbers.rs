//! The numbers of an error by the names of its fields.

use pellicle_cli::Failure;
use pellicle_contact::{ContactError, IndenterError};
use pellicle_influence::InfluenceError;
use pellicle_kernel::KernelError;
use pellicle_texture::TextureError;

/// Names and values.
type Numbers = Vec<(&'static str, f64)>;

/// The numbers of a failure; none of most.
pub fn of(failure: &Failure) -> Numbers {
    match failure {
        Failure::Kernel(error) => of_kernel(error),
        Failure::Influence(error) | Failure::Inside(error) => of_influence(error),
        Failure::Texture(error) => of_texture(error),
        Failure::Indenter(error) => of_indenter(error),
        Failure::Contact(error) => of_contact(error),
        Failure::Memory { need, available } => vec![
            ("needed", need.bytes as f64),
            ("available", *available as f64),
        ],
        _ => Numbers::new(),
    }
}

fn of_kernel(error: &KernelError) -> Numbers {
    match *error {
        KernelError::YoungModulus { found }
        | KernelError::PoissonRatio { found }
        | KernelError::Thickness { found }
        | KernelError::NormalCompliance { found }
        | KernelError::ShearCompliance { found }
        | KernelError::Wavenumber { found } => vec![("found", found)],
        KernelError::ModulusRatio {
            layer,
            found,
            smallest,
            largest,
        } => vec![
            ("layer", layer as f64),
            ("found", found),
            ("smallest", smallest),
            ("largest", largest),
        ],
        _ => Numbers::new(),
    }
}

fn of_influence(error: &InfluenceError) -> Numbers {
    match *error {
        InfluenceError::ElementSide { found } => vec![("found", found)],
        InfluenceError::TableSize { found, largest } => {
            vec![("found", found as f64), ("largest", largest as f64)]
        }
        InfluenceError::Depth { found, largest } => vec![("found", found), ("largest", largest)],
        InfluenceError::Kernel(ref error) => of_kernel(error),
        _ => Numbers::new(),
    }
}

fn of_texture(error: &TextureError) -> Numbers {
    match *error {
        TextureError::NotPositive { found, .. }
        | TextureError::Negative { found, .. }
        | TextureError::NotFinite { found, .. } => vec![("found", found)],
        TextureError::Overlap { radius, period } => vec![("radius", radius), ("period", period)],
        _ => Numbers::new(),
    }
}

fn of_indenter(error: &IndenterError) -> Numbers {
    match *error {
        IndenterError::NotPositive { found, .. }
        | IndenterError::Negative { found, .. }
        | IndenterError::Angle { found, .. } => vec![("found", found)],
        _ => Numbers::new(),
    }
}

fn of_contact(error: &ContactError) -> Numbers {
    match *error {
        ContactError::Force { force } => vec![("force", force)],
        ContactError::Penetration { penetration } => vec![("penetration", penetration)],
        ContactError::Tolerance { tolerance } => vec![("tolerance", tolerance)],
        ContactError::ElementsTooLarge {
            side,
            element_side,
            radius,
            wanted,
        } => vec![
            ("side", side),
            ("element_side", element_side),
            ("radius", radius),
            ("wanted", wanted),
        ],
        ContactError::DomainTooSmall { side, trials } => {
            vec![("side", side), ("trials", trials as f64)]
        }
        ContactError::Texture(ref error) => of_texture(error),
        ContactError::Indenter(ref error) => of_indenter(error),
        ContactError::Influence(ref error) => of_influence(error),
        _ => Numbers::new(),
    }
}
