//! Tests of the fits, on toys with closed forms and on simulated contacts.

mod coatings;
mod contact_curves;
mod contact_fit;
mod fits;
