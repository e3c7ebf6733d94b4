//! Random case files as a user might write them: every kind of body, relief, indenter, load and option.

use std::fmt::Write;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Moduli of the base, in Pa, and scales of length, in m.
const MODULI: [f64; 2] = [1e5, 1e12];
const SCALES: [f64; 2] = [1e-8, 1e-3];

/// The text of the case of a seed.
pub fn random_case(seed: u64) -> String {
    let mut draw = Draw {
        random: ChaCha8Rng::seed_from_u64(seed),
        text: String::new(),
    };
    draw.case();
    draw.text
}

struct Draw {
    random: ChaCha8Rng,
    text: String,
}

impl Draw {
    fn case(&mut self) {
        let radius = self.decades(SCALES);
        let modulus = self.decades(MODULI);
        // Hertz's contact radius, on which all lengths but the indenter's depend.
        let contact = radius * self.decades([3e-3, 0.1]);
        let layers = self.foundation(contact, modulus);
        self.surface(contact, modulus);
        self.indenter(radius, contact);
        let periodic = self.one_in(6);
        let springs = self.text.contains("kind = \"cylinders\"");
        let force = 4.0 / 3.0 * modulus * contact.powi(3) / radius;
        let depth = contact * contact / radius;
        if !periodic && self.one_in(3) {
            self.line(&format!("[load]\npenetration = {depth:e}"));
        } else if self.one_in(6) {
            self.line(&format!(
                "[load]\nforces = {{ from = {:e}, to = {force:e}, count = 3 }}",
                force / 5.0
            ));
        } else {
            self.line(&format!("[load]\nforce = {force:e}"));
        }
        let elements = self.random.random_range(12..40);
        self.line(&format!("[grid]\nelements = {elements}"));
        if periodic {
            self.line(&format!(
                "side = {:e}\nboundary = \"periodic\"",
                4.0 * contact
            ));
        } else if !springs && self.one_in(3) {
            let (friction, direction) = (self.part(), 360.0 * self.part());
            self.line(&format!(
                "[stress]\nfriction = {friction:.3}\ndirection = {direction:.1}"
            ));
        } else if layers > 0 && self.one_in(8) {
            self.line(&format!("[solver]\nhardness = {:e}", 0.05 * modulus));
        }
    }

    /// Up to three layers, which need not be bonded or homogeneous.
    fn foundation(&mut self, contact: f64, modulus: f64) -> usize {
        let count = self.random.random_range(0..4);
        let rigid = count > 0 && self.one_in(6);
        if rigid {
            self.line("[foundation]\nsubstrate = \"rigid\"");
        } else {
            let poisson_ratio = self.poisson_ratio();
            self.line(&format!(
                "[foundation]\nsubstrate = {{ young_modulus = {modulus:e}, poisson_ratio = {poisson_ratio} }}"
            ));
        }
        for _ in 0..count {
            let thickness = contact * self.decades([0.1, 10.0]);
            let layer = modulus * self.decades([0.1, 10.0]);
            let poisson_ratio = self.poisson_ratio();
            self.line(&format!(
                "[[foundation.layer]]\nthickness = {thickness:e}\npoisson_ratio = {poisson_ratio}"
            ));
            if self.one_in(8) {
                self.line(&format!(
                    "young_modulus = {{ from = {layer:e}, to = {modulus:e}, profile = \"linear\" }}"
                ));
            } else {
                self.line(&format!("young_modulus = {layer:e}"));
            }
            if self.one_in(4) {
                self.line("interface = \"frictionless\"");
            }
            if self.one_in(4) {
                self.line(&format!("yield_strength = {:e}", 0.01 * layer));
            }
        }
        count
    }

    fn surface(&mut self, contact: f64, modulus: f64) {
        let height = contact * self.decades([1e-4, 1e-2]);
        let springs = modulus * self.decades([0.1, 10.0]);
        match self.random.random_range(0..4) {
            0 => self.line(&format!(
                "[surface]\nkind = \"film\"\nthickness = {height:e}\nyoung_modulus = {springs:e}"
            )),
            1 => {
                let period = contact * self.decades([0.3, 2.0]);
                let radius = period * (0.2 + 0.25 * self.part());
                let lattice = ["square", "hexagonal"][self.random.random_range(0..2)];
                self.line(&format!(
                    "[surface]\nkind = \"cylinders\"\nradius = {radius:e}\nheight = {height:e}\nperiod = {period:e}\nlattice = \"{lattice}\"\nyoung_modulus = {springs:e}"
                ));
            }
            _ => {}
        }
    }

    fn indenter(&mut self, radius: f64, contact: f64) {
        self.line("[indenter]");
        let tip = contact / 3.0;
        match self.random.random_range(0..6) {
            0 => self.line(&format!("kind = \"sphere\"\nradius = {radius:e}")),
            1 => self.line(&format!(
                "kind = \"cone\"\nhalf_angle = {:.2}\ntip_radius = {tip:e}",
                88.0 - 10.0 * self.part()
            )),
            2 => self.line(&format!("kind = \"berkovich\"\ntip_radius = {tip:e}")),
            3 => self.line(&format!("kind = \"flat-punch\"\nradius = {contact:e}")),
            _ => self.line(&format!("kind = \"paraboloid\"\nradius = {radius:e}")),
        }
    }

    fn poisson_ratio(&mut self) -> f64 {
        [0.0, 0.2, 0.3, 0.45, 0.5][self.random.random_range(0..5)]
    }

    fn line(&mut self, text: &str) {
        let written = writeln!(self.text, "{text}");
        debug_assert!(written.is_ok(), "writing to a string cannot fail");
    }

    /// A number whose logarithm is uniform between two ends.
    fn decades(&mut self, [from, to]: [f64; 2]) -> f64 {
        from * (to / from).powf(self.part())
    }

    /// A number from 0 to 1.
    fn part(&mut self) -> f64 {
        self.random.random()
    }

    fn one_in(&mut self, count: u32) -> bool {
        self.random.random_range(0..count) == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_gives_one_text_of_toml_and_seeds_differ() {
        for seed in 0..20 {
            let text = random_case(seed);
            assert_eq!(text, random_case(seed));
            assert_ne!(text, random_case(seed + 1));
            text.parse::<toml::Table>().unwrap();
        }
    }
}
