; run: failed line 3: parameter Q17 is undefined; assign it before this block reads it
BEGIN PGM BAD MM
Q1 = Q17 * 2
END PGM BAD MM
