//! Tests of the fits, on toys with closed forms and on simulated contacts, and of the reader of measured curves.

mod coatings;
mod contact_curves;
mod contact_fit;
mod curves;
mod documents;
mod fits;
mod imprint;
mod indentation;
