; run: failed line 4: Kinematic access not possible: the machine has no rotary axis
BEGIN PGM BAD MM
TOOL CALL 30 Z
TCH PROBE 451 MEASURE KINEMATICS ~
    Q407=+15  ;SPHERE RADIUS
END PGM BAD MM
