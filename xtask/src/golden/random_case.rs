//! Random case files as a user might write them: every kind of body, surface, indenter, load and option, and now and
//! then a fault. One seed always gives the same text and maps.

mod draw;
mod fault;
mod foundation;
mod indenter;
mod map;
mod requests;
mod surface;

use super::run::InputFile;
use draw::Draw;

/// One text in so many has a fault.
const FAULTY: u32 = 8;

/// A case with the maps that it names.
#[derive(Debug, PartialEq)]
pub struct RandomCase {
    /// The case file.
    pub text: String,
    /// The files of its maps.
    pub maps: Vec<InputFile>,
}

/// The sizes that go together in a case, so that most contacts are reasonable.
#[derive(Debug, Clone, Copy)]
struct Scales {
    /// Young's modulus of the base, E.
    modulus: f64,
    /// Radius of the indenter, R.
    radius: f64,
    /// Hertz's contact radius, a.
    contact: f64,
    /// Side of the domain, if the case gives it.
    side: Option<f64>,
    /// Whether the domain is a periodic cell.
    periodic: bool,
}

impl Scales {
    fn draw(draw: &mut Draw) -> Self {
        let [moduli, radii] = if draw.has_units() {
            [[1e5, 1e12], [1e-8, 1e-3]]
        } else {
            [[0.1, 10.0], [0.1, 10.0]]
        };
        let radius = draw.decades(radii);
        let contact = radius * draw.decades([3e-3, 0.1]);
        let periodic = draw.one_in(7);
        let side = contact * draw.decades([2.5, 6.0]);
        Self {
            modulus: draw.decades(moduli),
            radius,
            contact,
            side: (periodic || draw.one_in(3)).then_some(side),
            periodic,
        }
    }

    /// Hertz's penetration D = a²/R.
    fn depth(self) -> f64 {
        self.contact * self.contact / self.radius
    }

    /// Hertz's force Q = 4 E a³ / (3 R).
    fn force(self) -> f64 {
        4.0 / 3.0 * self.modulus * self.contact.powi(3) / self.radius
    }

    /// The size of the pressure, E a/R.
    fn pressure(self) -> f64 {
        self.modulus * self.contact / self.radius
    }
}

/// The case of a seed.
pub fn random_case(seed: u64) -> RandomCase {
    let mut draw = Draw::new(seed);
    let scales = Scales::draw(&mut draw);
    foundation::draw(&mut draw, scales);
    surface::draw(&mut draw, scales);
    indenter::draw(&mut draw, scales);
    requests::draw(&mut draw, scales);
    if draw.one_in(FAULTY) {
        fault::draw(&mut draw);
    }
    draw.case()
}

#[cfg(test)]
mod tests {
    use super::super::collection::RANDOM_CASES;
    use super::*;

    #[test]
    fn a_seed_gives_one_case_and_seeds_differ() {
        for seed in 0..20 {
            let case = random_case(seed);
            assert_eq!(case, random_case(seed));
            assert_ne!(case, random_case(seed + 1));
        }
    }

    /// Every word of the case file that chooses something, and what a fault leaves behind.
    #[test]
    fn the_random_cases_together_hold_every_kind_of_everything() {
        let cases: Vec<RandomCase> = (0..RANDOM_CASES).map(random_case).collect();
        let wanted = "\
            substrate = \"rigid\" | [[foundation.layer]] | profile = \"linear\" | profile = \"exponential\" | interface = \"bonded\"
            interface = \"frictionless\" | normal_compliance = | shear_compliance = | yield_strength = | tensile_strength =
            interface_shear_strength = | interface_tensile_strength = | hardness = | 
            kind = \"bare\" | kind = \"film\" | kind = \"cylinders\" | kind = \"rough\"
            lattice = \"square\" | lattice = \"hexagonal\" | offset = [ | law = \"logarithmic\" | law = \"linear\" | compliance =
            .npy\" | .csv\" | .txt\" | .gsf\" | side = | sides = [ | height_unit = | interpolation = \"linear\"
            kind = \"paraboloid\" | kind = \"sphere\" | kind = \"cone\" | kind = \"berkovich\" | kind = \"vickers\"
            kind = \"cube-corner\" | kind = \"flat-punch\" | half_angle = | tip_radius = | face_angle =
            force = | forces = { | forces = [ | penetration = | penetrations = { | penetrations = [ | spacing = \"log\"
            sensitivities = true | boundary = \"periodic\" | tolerance = | method = \"active-set\" | [stress] | friction =
            direction = | depths = [ | extent = | GPa\" | um\" | mN\" | deg\"";
        for word in wanted.split(['|', '\n']).map(str::trim) {
            let holds = |case: &&RandomCase| case.text.contains(word);
            let count = cases.iter().filter(holds).count();
            assert!(count >= 3, "{word}: in {count} cases");
        }
        let is_toml = |case: &&RandomCase| case.text.parse::<toml::Table>().is_ok();
        let read = cases.iter().filter(is_toml).count();
        assert!((270..cases.len()).contains(&read), "{read} are TOML");
    }
}
