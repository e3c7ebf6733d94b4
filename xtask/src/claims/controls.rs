//! Controls: every check named in the file holds in some made-up world and fails in another, by the path of real claims.

use std::path::Path;
use std::rc::Rc;

use super::evaluation::evaluate;
use super::evidence::{Numbers, Subject};
use super::made_up::{CYLINDERS, displaced, power_law, pressed, with_fading_film};
use super::*;

/// What there is to look at in a world where some sentences are true and others false.
struct World {
    /// Fields of the first case and of the second.
    fields: [ContactFields; 2],
    /// Curves of the first case and of the second.
    curves: [Curve; 2],
    share_between: f64,
    peak_at: [f64; 2],
    /// The largest pressure grows as this power of N.
    growth: f64,
}

impl World {
    /// Dishes on the elements, some contact between them near the axis, a film whose effect fades.
    fn of_the_paper() -> Self {
        let mut one = pressed(|radius, relative| {
            let dish = (1.0 + relative.powi(4)) * (5.0 - radius);
            f64::from(relative < 1.0 || (relative > 1.9 && radius < 1.0)) * dish.min(9.0 - radius)
        });
        let rising = |x: f64| 1.0 - 0.1 * (std::f64::consts::TAU * x).cos().min(0.0).abs();
        one.displacement = displaced(rising).displacement;
        Self {
            fields: [one, pressed(|_, _| 1.0)],
            curves: [with_fading_film(), power_law(1.0, 2.0 / 3.0)],
            share_between: 0.0,
            peak_at: [0.24, 0.0],
            growth: 0.0,
        }
    }

    /// Everything touches with one pressure; a straight line and a stiffening curve.
    fn flat() -> Self {
        let mut one = pressed(|_, _| 1.0);
        one.displacement = displaced(|x| 1.0 - 0.2 * x).displacement;
        Self {
            fields: [one.clone(), one],
            curves: [power_law(1.0, 1.0), power_law(1.0, 1.5)],
            share_between: 0.5,
            peak_at: [1.2, 0.0],
            growth: 0.5,
        }
    }

    /// Springs beside a dome, and two curves of one shape.
    fn of_springs() -> Self {
        let mut one = pressed(|radius, _| (2.0 - radius).max(0.0));
        one.displacement = displaced(|x| 1.0 + x * x).displacement;
        Self {
            fields: [
                one,
                pressed(|radius, _| (4.0 - radius * radius).max(0.0).sqrt()),
            ],
            curves: [1.0, 1.1].map(|scale| power_law(scale, 2.0 / 3.0)),
            share_between: 0.01,
            peak_at: [0.0, 0.0],
            growth: 1.0,
        }
    }

    fn index(subject: Subject<'_>) -> usize {
        usize::from(subject.case == "other")
    }
}

impl Evidence for World {
    fn fields(&mut self, subject: Subject<'_>) -> Result<Rc<ContactFields>, XtaskError> {
        Ok(Rc::new(self.fields[Self::index(subject)].clone()))
    }

    fn cylinders(&mut self, _: Subject<'_>) -> Result<Cylinders, XtaskError> {
        Ok(CYLINDERS)
    }

    fn numbers(&mut self, subject: Subject<'_>) -> Result<Numbers, XtaskError> {
        Ok(Numbers {
            element_side: 5.0 / subject.elements as f64,
            penetration: 1.0,
            max_pressure: (subject.elements as f64).powf(self.growth),
            max_pressure_at: self.peak_at,
            contact_area: 1.0,
            contact_area_between: self.share_between,
            spring_length: 0.01,
        })
    }

    fn curve(&mut self, subject: Subject<'_>) -> Result<Rc<Curve>, XtaskError> {
        Ok(Rc::new(self.curves[Self::index(subject)].clone()))
    }
}

/// A recorded claim with this check, about the made-up cases.
fn about_made_up_cases(checker: Checker) -> Claim {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let file = ClaimsFile::read(&root.join(FILE)).unwrap();
    let mut claim = file
        .claims()
        .find(|claim| claim.checker == checker)
        .unwrap()
        .clone();
    for (name, case) in ["one", "other"].into_iter().zip(&mut claim.cases) {
        name.clone_into(case);
    }
    claim
}

#[test]
fn every_check_holds_in_one_world_and_fails_in_another() {
    for checker in Checker::ALL {
        let claim = about_made_up_cases(checker);
        let verdicts =
            [World::of_the_paper(), World::flat(), World::of_springs()].map(|mut world| {
                evaluate(&claim, &claim.elements, &mut world)
                    .unwrap()
                    .verdict
            });
        for wanted in [Verdict::BorneOut, Verdict::NotBorneOut] {
            assert!(verdicts.contains(&wanted), "{checker:?}: {verdicts:?}");
        }
    }
}
