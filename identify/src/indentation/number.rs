//! The numbers of an indentation, each declared once.

/// Declares the numbers: `Variant "name", "symbol", "unit", "meaning"`.
macro_rules! numbers {
    ($($variant:ident $name:literal, $symbol:literal, $unit:literal, $meaning:literal;)+) => {
        /// A number of an indentation.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum IndentationNumber {
            $(#[doc = $meaning] $variant,)+
        }

        impl IndentationNumber {
            /// All numbers, in the order of their table.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$variant),+];

            /// Its name in tables and files.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)+ }
            }

            /// Its symbol in ISO 14577.
            #[must_use]
            pub fn symbol(self) -> &'static str {
                match self { $(Self::$variant => $symbol,)+ }
            }

            /// Its SI unit; `1` for none.
            #[must_use]
            pub fn unit(self) -> &'static str {
                match self { $(Self::$variant => $unit,)+ }
            }

            /// Its meaning.
            #[must_use]
            pub fn meaning(self) -> &'static str {
                match self { $(Self::$variant => $meaning,)+ }
            }
        }
    };
}

numbers! {
    MaxDepth "max_depth", "h_max", "m", "depth at the end of the hold at the largest force";
    MaxForce "max_force", "P_max", "N", "largest force";
    ContactStiffness "contact_stiffness", "S", "N/m", "slope of the unloading at the largest force, `m P_max/(h − h_f)`";
    Exponent "exponent", "m", "1", "exponent of the unloading";
    FinalDepth "final_depth", "h_f", "m", "depth at which the law of the unloading has no force";
    ContactDepth "contact_depth", "h_c", "m", "depth of the contact, `h_max − ε P_max/S`";
    Area "area", "A", "m^2", "projected area of the contact, `A(h_c)`";
    ReducedModulus "reduced_modulus", "E_r", "Pa", "`√π S/(2 β √A)`";
    IndentationModulus "indentation_modulus", "E_IT", "Pa", "Young's modulus of the body as if it were homogeneous";
    IndentationHardness "indentation_hardness", "H_IT", "Pa", "`P_max/A`";
    MartensHardness "martens_hardness", "HM", "Pa", "largest force over the surface of the indenter within the depth, `P_max/A_s(h_max)`";
    Creep "creep", "C_IT", "1", "growth of the depth in the hold at the largest force over the depth at its beginning";
    ElasticWorkRatio "elastic_work_ratio", "η_IT", "1", "work of the unloading over that of the loading and the hold";
    DriftRate "drift_rate", "ḣ", "m/s", "drift of the depth that is taken out";
}

impl IndentationNumber {
    /// Its place among all.
    #[must_use]
    pub fn place(self) -> usize {
        self as usize
    }
}
