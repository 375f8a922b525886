//! How a method declares its parameters.

/// Makes the struct that a method works with: of each parameter its name, type, default, range and meaning, then
/// groups of parameters that several methods share. An enum needs no range; its words are serde's.
///
/// What is read from a configuration, refused, listed and written into results comes from the same lines:
///
/// ```
/// use svbench::methods::Parameters;
///
/// svbench::parameters! {
///     /// What all maps have.
///     pub struct Common {
///         bias: f64 = 2.0, in 0.0..=100.0, "in texels";
///     }
/// }
///
/// svbench::parameters! {
///     /// What this map is drawn with.
///     pub struct Map {
///         resolution: u32 = 2048, in 1..=65536, "side in texels";
///         ..common: Common;
///     }
/// }
///
/// let map = Map::default();
/// assert_eq!((map.resolution, map.common.bias), (2048, 2.0));
/// let [resolution, bias] = &map.parameters()[..] else { panic!() };
/// assert_eq!(resolution.domain.to_string(), "from 1 to 65536");
/// assert_eq!((bias.name, bias.default_text().as_str()), ("bias", "2.0"));
///
/// svbench::parameters! {
///     /// A method may have none.
///     pub struct Rays {}
/// }
/// assert!(Rays::default().parameters().is_empty());
/// ```
///
/// Gives `Debug`, `Clone`, `Default` and [`Parameters`](crate::methods::Parameters).
#[macro_export]
macro_rules! parameters {
    (@domain $type:ty) => { $crate::methods::Domain::of::<$type>() };
    (@domain $type:ty, $domain:expr) => { $crate::methods::Domain::from($domain) };
    (
        $(#[$meta:meta])*
        $vis:vis struct $name:ident $(<$kind:ident: $bound:path>)? {
            $(
                $(#[$of_field:meta])*
                $field_vis:vis $field:ident: $type:ty = $default:expr, $(in $domain:expr,)? $words:expr;
            )*
            $(..$group:ident: $group_type:ty;)*
        }
    ) => {
        $(#[$meta])*
        #[derive(Debug, Clone)]
        $vis struct $name $(<$kind: $bound>)? {
            $($(#[$of_field])* $field_vis $field: $type,)*
            $($group: $group_type,)*
            $(kind: ::std::marker::PhantomData<$kind>,)?
        }

        impl $(<$kind: $bound>)? Default for $name $(<$kind>)? {
            fn default() -> Self {
                Self {
                    $($field: $default,)*
                    $($group: <$group_type>::default(),)*
                    $(kind: ::std::marker::PhantomData::<$kind>,)?
                }
            }
        }

        impl $(<$kind: $bound>)? $crate::methods::Parameters for $name $(<$kind>)? {
            fn parameters(&self) -> Vec<$crate::methods::Parameter> {
                #[allow(unused_mut, reason = "there may be no group")]
                let mut all = vec![$($crate::methods::Parameter::new(
                    stringify!($field),
                    (&self.$field, &$default),
                    $crate::parameters!(@domain $type $(, $domain)?),
                    $words,
                )),*];
                $(all.extend($crate::methods::Parameters::parameters(&self.$group));)*
                all
            }

            fn set(
                &mut self,
                name: &str,
                value: &$crate::methods::ParameterValue<'_>,
            ) -> Result<bool, $crate::methods::ParameterError> {
                // Not used where there is no parameter.
                let _ = (name, value);
                Ok(false
                    $(|| (name == stringify!($field) && {
                        self.$field = $crate::methods::read_parameter(value)?;
                        true
                    }))*
                    $(|| $crate::methods::Parameters::set(&mut self.$group, name, value)?)*
                )
            }
        }
    };
}
